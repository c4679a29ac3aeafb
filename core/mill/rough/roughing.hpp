// Roughing along one direction: level by level from the top, as deep as the tool comes.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/base/helpers.hpp"
#include "core/mill/drive/mill_stroke.hpp"
#include "core/mill/map/site.hpp"
#include "core/mill/rough/clearing.hpp"

namespace sculpt {

/// What stands higher than this above a level is to come off, the rest are cusps.
inline double cusp_m(const MillTool& tool) {
  return 0.35 * tool.max_depth_m;
}
/// A way to a pass and back is worth its while for that of two diameters at full engagement (m^3).
inline double min_pass_m3(const MillTool& tool) {
  return 2 * 2 * tool.cutter.radius_m * tool.max_depth_m * tool.max_width_m;
}

/// What of a level is cut with what.
struct RoughLevel {
  const MillTool& tool;
  double height = 0;                 ///< of the tip
  const std::vector<char>& is_free;  ///< by cell: may the tip be there?
  const std::vector<char>& wanted;   ///< those of them where it is to take off what it can
  double seam_m = 0;                 ///< as `ClearingTask`
  double min_engagement = 0;         ///< of depth times width of cut, by the length of all ways: else it is left
};

/// Where the robot can hold the tip (tool frame). Any thread.
using IsReachable = std::function<bool(const Vec3& tip)>;

/// The cells at which the tip may be at a height.
std::vector<char> free_cells(const Site& site, double height, const IsReachable& reachable, const Helpers& helpers);

/// How the strokes of a level are joined.
struct LevelWays {
  Vec3 from;                          ///< where the tip is (tool frame, in the air or anywhere at rest)
  std::array<double, 2> min_heights;  ///< of ways over from pass to pass: the first that the robot can go counts
  double stray_m = 0;                 ///< of strokes that cut
  IsReachable reachable;
};

struct LevelStrokes {
  std::vector<MillStroke> strokes;
  bool is_cut_off = false;  ///< there was a pass that the robot cannot come over to from where the tip was
};

/// The strokes of one level, in the layout of rows that takes off most for its length; nothing if the level has nothing
/// that the tool can take off, or too little for the ways to it. `surface` loses what they cut.
LevelStrokes rough_level(const Site& site, const RoughLevel& level, const LevelWays& ways, StockTop& surface,
                         const Helpers& helpers);

}  // namespace sculpt
