#include "core/mill/chip_load.hpp"

#include <algorithm>

namespace sculpt {
namespace {

/// What a replay allows is 1.1.
constexpr double slack = 1.08;
/// Layers of voxels, of which two are a tenth.
constexpr double layers = 20;
/// Of depth times width times radius.
constexpr double plunged_share = 0.5;

}  // namespace

void ChipLoad::begin(double plunged_m3) {
  load_m3_ = 0;
  last_ = {{plunged_m3, 0.0}};
}

bool ChipLoad::bears(double volume_m3, double length_m) {
  if (load_m3_ + volume_m3 > limit_.burst_m3) return false;
  double window_m3 = volume_m3, window_m = length_m;
  auto first = last_.end();
  while (first != last_.begin() && window_m < limit_.window_m) {
    --first;
    window_m3 += first->first;
    window_m += first->second;
  }
  // Of the first one in it all may come off at its end.
  if (window_m3 > limit_.window_m2 * std::max(length_m, limit_.window_m)) return false;
  last_.erase(last_.begin(), first);
  last_.emplace_back(volume_m3, length_m);
  load_m3_ = std::max(volume_m3, load_m3_ + volume_m3 - limit_.chip_m2 * length_m);
  return true;
}

double counted_window_m(const MillTool& tool, double voxel_m) {
  return std::max(2 * tool.cutter.radius_m, layers * voxel_m);
}

ChipLoad counted_load(const MillTool& tool, double voxel_m) {
  const double chip_m2 = tool.max_depth_m * tool.max_width_m, diameter_m = 2 * tool.cutter.radius_m;
  // A box holds the centres of no more voxels than (side / voxel + 1), along each side. A replay looks at stretches of
  // a diameter or longer.
  const double counted_m2 = slack * chip_m2 + voxel_m * (tool.max_depth_m + tool.max_width_m + voxel_m);
  return ChipLoad({chip_m2, (counted_m2 - chip_m2) * diameter_m + counted_m2 * voxel_m, counted_window_m(tool, voxel_m),
                   slack * chip_m2});
}

double max_plunged_m3(const MillTool& tool, double voxel_m) {
  return plunged_share * tool.max_depth_m * (tool.max_width_m + voxel_m) * tool.cutter.radius_m;
}

}  // namespace sculpt
