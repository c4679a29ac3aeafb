#include "core/verify/material/held_voxels.hpp"

#include <algorithm>
#include <utility>

namespace sculpt {
namespace {

// From the voxels of `here`, which are in `reached`, over faces through `open`: all that is met joins `reached`, in
// rings. `here` and `next` are memory to work in.
template <typename Visit>
void spread(const VoxelSet& open, VoxelSet& reached, std::vector<Voxel>& here, std::vector<Voxel>& next,
            Visit&& visit) {
  const Grid grid{open.n(), 1, Vec3::Zero()};
  for (; !here.empty(); std::swap(here, next)) {
    next.clear();
    for (const Voxel from : here)
      for (const Voxel side : face_steps) {
        const Voxel to = from + side;
        if (!grid.contains(to) || !open.contains(to) || reached.contains(to)) continue;
        reached.insert(to);
        visit(to);
        next.push_back(to);
      }
  }
}

VoxelSet spread_from_table(const VoxelSet& standing) {
  VoxelSet held(standing.n());
  std::vector<Voxel> here, next;
  for (int j = 0; j < standing.n(); ++j)
    for (int i = 0; i < standing.n(); ++i)
      if (standing.contains({i, j, 0})) {
        held.insert({i, j, 0});
        here.push_back({i, j, 0});
      }
  spread(standing, held, here, next, [](Voxel) {});
  return held;
}

// What is not the target and can be come at from the sides or from above.
VoxelSet spread_from_outside(const VoxelSet& keep) {
  const int last = keep.n() - 1;
  VoxelSet open = keep, reached(keep.n());
  for (std::uint64_t& word : open.words()) word = ~word;
  std::vector<Voxel> here, next;
  const auto enter = [&](Voxel v) {
    if (!open.contains(v) || reached.contains(v)) return;
    reached.insert(v);
    here.push_back(v);
  };
  for (int a = 0; a <= last; ++a)
    for (int b = 0; b <= last; ++b)
      for (const Voxel v : {Voxel{0, a, b}, Voxel{last, a, b}, Voxel{a, 0, b}, Voxel{a, last, b}, Voxel{a, b, last}})
        enter(v);
  spread(open, reached, here, next, [](Voxel) {});
  return reached;
}

}  // namespace

VoxelSet find_never_held(const VoxelGrid& voxels) {
  VoxelSet finished = voxels.stock;
  finished -= spread_from_outside(voxels.keep);
  for (std::size_t at = 0; at < finished.words().size(); ++at) finished.words()[at] |= voxels.keep.words()[at];
  const VoxelSet held = spread_from_table(finished);
  finished -= held;
  return finished;
}

HeldVoxels::HeldVoxels(const VoxelSet& standing) : standing_(standing), held_(spread_from_table(standing)) {}

HeldVoxels::Gain HeldVoxels::put_back(Voxel voxel, const VoxelSet& may_fall) {
  standing_.insert(voxel);
  const Grid grid{held_.n(), 1, Vec3::Zero()};
  const bool is_held = voxel.k == 0 || std::any_of(face_steps.begin(), face_steps.end(), [&](Voxel side) {
                         return grid.contains(voxel + side) && held_.contains(voxel + side);
                       });
  if (!is_held) return {};
  held_.insert(voxel);
  here_.assign(1, voxel);
  Gain gain;
  spread(standing_, held_, here_, next_, [&](Voxel gained) {
    ++gain.all;
    gain.unforeseen += !may_fall.contains(gained);
  });
  return gain;
}

}  // namespace sculpt
