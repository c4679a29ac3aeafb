#include "core/place/certify_stand.hpp"

#include <algorithm>
#include <vector>

#include "core/place/arm/sectors.hpp"
#include "core/place/tool_room_views.hpp"
#include "core/sweep/directions.hpp"

namespace sculpt {
namespace {

/// Which of study_views has the tool's axis of each direction: some axes have several fields.
std::vector<std::size_t> find_bits(const Directions& directions, int n) {
  const auto axis = [](const ToolView& view) { return view.along(view.lean); };
  const std::vector<ToolView> views = study_views(n);
  std::vector<std::size_t> bits;
  for (std::size_t direction = 0; direction < directions.size(); ++direction) {
    const auto same = [&](const ToolView& view) { return axis(view) == axis(directions.view(direction)); };
    bits.push_back(static_cast<std::size_t>(std::ranges::find_if(views, same) - views.begin()));
  }
  return bits;
}

}  // namespace

CertifiedShare certify_stand(const Cell& cell, const VoxelGrid& voxels, const RunContext& run) {
  const Grid grid = cell.grid(voxels.n());
  const Scene scene(cell, grid, voxels.stock);
  const Configuration home = cell.home(scene.chain());
  CertifiedShare share;
  share.home_contact = scene.describe_contact(home);
  Directions directions(scene, home, run);
  directions.find_straight_fields();
  for (std::size_t direction = 0; direction < directions.size(); ++direction) directions.field(direction);
  const ViewSets views = find_views(voxels, Access::along_views, run);
  const std::vector<std::size_t> bits = find_bits(directions, voxels.n());
  VoxelSet removable = voxels.stock;
  removable -= voxels.keep;
  for_each_voxel(removable, [&](Voxel v) {
    ++share.removable;
    const ViewSet asked = views[removable.index(v)];
    share.tool += asked == 0;
    for (std::size_t direction = 0; direction < directions.size(); ++direction) {
      if (!(asked >> bits[direction] & 1)) continue;
      const Voxel cell_of = directions.view(direction).cell(v);
      if (!directions.may_reach(direction, Vec3(cell_of.i, cell_of.j, cell_of.k))) continue;
      ++share.held;
      return;
    }
  });
  return share;
}

}  // namespace sculpt
