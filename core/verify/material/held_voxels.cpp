#include "core/verify/material/held_voxels.hpp"

#include <algorithm>
#include <utility>

#include "core/verify/material/reached.hpp"

namespace sculpt {
namespace {

VoxelSet on_the_table(const VoxelSet& standing) {
  VoxelSet lowest(standing.n());
  for (int j = 0; j < standing.n(); ++j)
    for (int i = 0; i < standing.n(); ++i) lowest.insert({i, j, 0});
  return reached_through(standing, std::move(lowest));
}

// What is not the target and can be come at from the sides or from above.
VoxelSet spread_from_outside(const VoxelSet& keep) {
  const int last = keep.n() - 1;
  VoxelSet open = keep, shell(keep.n());
  for (std::uint64_t& word : open.words()) word = ~word;
  for (int a = 0; a <= last; ++a)
    for (int b = 0; b <= last; ++b)
      for (const Voxel v : {Voxel{0, a, b}, Voxel{last, a, b}, Voxel{a, 0, b}, Voxel{a, last, b}, Voxel{a, b, last}})
        shell.insert(v);
  return reached_through(open, std::move(shell));
}

}  // namespace

VoxelSet find_never_held(const VoxelGrid& voxels) {
  VoxelSet finished = voxels.stock;
  finished -= spread_from_outside(voxels.keep);
  for (std::size_t at = 0; at < finished.words().size(); ++at) finished.words()[at] |= voxels.keep.words()[at];
  finished -= on_the_table(finished);
  return finished;
}

HeldVoxels::HeldVoxels(const VoxelSet& standing)
    : standing_(standing), held_(on_the_table(standing)), hanging_(standing_.size() - held_.size()) {}

HeldVoxels::Gain HeldVoxels::put_back(Voxel voxel, const VoxelSet& may_fall) {
  standing_.insert(voxel);
  const Grid grid{held_.n(), 1, Vec3::Zero()};
  const bool is_held = voxel.k == 0 || std::any_of(face_steps.begin(), face_steps.end(), [&](Voxel side) {
                         return grid.contains(voxel + side) && held_.contains(voxel + side);
                       });
  if (!is_held) {
    ++hanging_;
    return {};
  }
  held_.insert(voxel);
  Gain gain;
  if (hanging_ == 0) return gain;
  for (here_.assign(1, voxel); !here_.empty(); std::swap(here_, next_)) {
    next_.clear();
    for (const Voxel from : here_)
      for (const Voxel side : face_steps) {
        const Voxel to = from + side;
        if (!grid.contains(to) || !standing_.contains(to) || held_.contains(to)) continue;
        held_.insert(to);
        ++gain.all;
        gain.unforeseen += !may_fall.contains(to);
        next_.push_back(to);
      }
  }
  hanging_ -= gain.all;
  return gain;
}

}  // namespace sculpt
