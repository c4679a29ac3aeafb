#include "core/mill/chip_load.hpp"

#include <algorithm>

namespace sculpt {
namespace {

/// What a replay allows is 1.1.
constexpr double slack = 1.08;
/// Of depth times width times radius.
constexpr double plunged_share = 0.5;

}  // namespace

bool ChipLoad::bears(double volume_m3, double length_m) {
  if (load_m3_ + volume_m3 > max_m3_) return false;
  load_m3_ = std::max(volume_m3, load_m3_ + volume_m3 - chip_m2_ * length_m);
  return true;
}

ChipLoad counted_load(const MillTool& tool, double voxel_m) {
  const double chip_m2 = tool.max_depth_m * tool.max_width_m;
  // A box holds the centres of no more voxels than (side / voxel + 1), along each side. A replay looks at stretches of
  // a diameter or longer.
  const double counted_m2 = slack * chip_m2 + voxel_m * (tool.max_depth_m + tool.max_width_m + voxel_m);
  return {chip_m2, (counted_m2 - chip_m2) * 2 * tool.cutter.radius_m + counted_m2 * voxel_m};
}

double max_plunged_m3(const MillTool& tool, double voxel_m) {
  return plunged_share * tool.max_depth_m * (tool.max_width_m + voxel_m) * tool.cutter.radius_m;
}

}  // namespace sculpt
