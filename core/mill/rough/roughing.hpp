// Roughing along one direction: level by level from the top, as deep as the tool comes.
#pragma once

#include <functional>
#include <vector>

#include "core/base/helpers.hpp"
#include "core/mill/drive/mill_stroke.hpp"
#include "core/mill/map/site.hpp"
#include "core/mill/rough/clearing.hpp"

namespace sculpt {

/// Of the depth of cut: what stands higher than this above a level is to come off, the rest are cusps.
inline constexpr double cusp_share = 0.35;
/// A way to a pass and back is worth its while for that of two diameters at full engagement (m^3).
inline double min_pass_m3(const MillTool& tool) {
  return 2 * 2 * tool.cutter.radius_m * tool.max_depth_m * tool.max_width_m;
}

/// Where the robot can hold the tip (tool frame).
using IsReachable = std::function<bool(const Vec3& tip)>;

/// The cells at which the tip may be at a height.
std::vector<char> free_cells(const Site& site, double height, const IsReachable& reachable);

/// How the strokes of a level are joined.
struct LevelWays {
  Vec3 from;              ///< where the tip is (tool frame, in the air or anywhere at rest)
  double min_height = 0;  ///< of ways over from pass to pass
  double stray_m = 0;     ///< of strokes that cut
};

/// The strokes of one level, in the layout of rows that takes off most for its length; nothing if the level has nothing
/// that the tool can take off. `surface` loses what they cut.
std::vector<MillStroke> rough_level(const Site& site, const ClearingTask& level, const LevelWays& ways,
                                    StockTop& surface, const Helpers& helpers);

}  // namespace sculpt
