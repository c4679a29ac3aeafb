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
    : standing_(standing), held_(on_the_table(standing)), back_(standing.n()) {}

void HeldVoxels::put_back(std::span<const Voxel> voxels, const VoxelSet& may_fall, std::vector<Gain>& pieces) {
  const Grid grid{held_.n(), 1, Vec3::Zero()};
  for (const Voxel voxel : voxels) back_.insert(voxel);
  const auto join = [&](Voxel voxel) {
    back_.erase(voxel);
    held_.insert(voxel);
    joined_.push_back(voxel);
  };
  for (const Voxel voxel : voxels)
    if (voxel.k == 0 || is_beside_held(voxel)) join(voxel);
  while (!joined_.empty()) {
    const Voxel from = joined_.back();
    joined_.pop_back();
    for (const Voxel side : face_steps) {
      const Voxel to = from + side;
      if (!grid.contains(to) || held_.contains(to)) continue;
      if (back_.contains(to)) {
        join(to);
      } else if (standing_.contains(to)) {
        pieces.push_back(hold_from(to, may_fall));
      }
    }
  }
  for (const Voxel voxel : voxels) {
    standing_.insert(voxel);
    back_.erase(voxel);
  }
}

HeldVoxels::Gain HeldVoxels::hold_from(Voxel voxel, const VoxelSet& may_fall) {
  const Grid grid{held_.n(), 1, Vec3::Zero()};
  Gain gain;
  const auto hold = [&](Voxel found) {
    held_.insert(found);
    ++gain.all;
    gain.unforeseen += !may_fall.contains(found);
    piece_.push_back(found);
    joined_.push_back(found);
  };
  hold(voxel);
  while (!piece_.empty()) {
    const Voxel from = piece_.back();
    piece_.pop_back();
    for (const Voxel side : face_steps)
      if (const Voxel to = from + side; grid.contains(to) && standing_.contains(to) && !held_.contains(to)) hold(to);
  }
  return gain;
}

bool HeldVoxels::is_beside_held(Voxel voxel) const {
  const Grid grid{held_.n(), 1, Vec3::Zero()};
  return std::any_of(face_steps.begin(), face_steps.end(),
                     [&](Voxel side) { return grid.contains(voxel + side) && held_.contains(voxel + side); });
}

}  // namespace sculpt
