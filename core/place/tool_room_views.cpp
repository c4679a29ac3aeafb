#include "core/place/tool_room_views.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/material/cavities.hpp"
#include "core/place/arm/sectors.hpp"

namespace sculpt {
namespace {

/// Of all voxels, those from which something that is kept stands in the way: beside the next step or further out.
VoxelSet find_blocked(const VoxelSet& keep, Voxel axis) {
  const int n = keep.n();
  const Grid grid{n, 1, Vec3::Zero()};
  std::vector<Voxel> beside;
  for (int part = 1; part < 8; ++part)
    if (const Voxel w{(part & 1) * axis.i, (part >> 1 & 1) * axis.j, (part >> 2) * axis.k};
        l1(w, {}) == (part & 1) + (part >> 1 & 1) + (part >> 2))
      beside.push_back(w);
  VoxelSet blocked(n);
  const auto from = [n](int step, int at) { return step > 0 ? n - 1 - at : at; };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Voxel v{from(axis.i, i), from(axis.j, j), from(axis.k, k)};
        const Voxel next = v + axis;
        const bool is_blocked =
            (grid.contains(next) && blocked.contains(next)) ||
            std::ranges::any_of(beside, [&](Voxel w) { return grid.contains(v + w) && keep.contains(v + w); });
        if (is_blocked) blocked.insert(v);
      }
  return blocked;
}

ViewSets find_open(const VoxelGrid& voxels) {
  const VoxelSet enclosed = find_enclosed(voxels);
  const auto n = static_cast<std::size_t>(voxels.n());
  ViewSets sets(n * n * n, 1);
  for_each_voxel(enclosed, [&](Voxel v) { sets[enclosed.index(v)] = 0; });
  return sets;
}

}  // namespace

ViewSets find_views(const VoxelGrid& voxels, Access access, const RunContext& run) {
  if (access == Access::any_way) return find_open(voxels);
  const VoxelSet& keep = voxels.keep;
  const std::vector<ToolView> views = study_views(keep.n());
  std::vector<VoxelSet> blocked(views.size());
  run.helpers.for_each_index(views.size(), [&](std::size_t view) {
    if (run.watch.stop.stop_requested()) throw Cancelled{};
    blocked[view] = find_blocked(keep, views[view].along(views[view].lean));
  });
  const auto n = static_cast<std::size_t>(keep.n());
  ViewSets sets(n * n * n, 0);
  for (std::size_t view = 0; view < views.size(); ++view)
    for (std::size_t at = 0; at < sets.size(); ++at)
      if (!(blocked[view].words()[at >> 6] >> (at & 63) & 1)) sets[at] |= ViewSet{1} << view;
  return sets;
}

}  // namespace sculpt
