// Points of a plan -> how their corners may be cut off, and how fast each piece may be gone through.
//
// At a point the edges' directions by r are u and w. The parabola of half length d strays from the edges by
// d |w - u| / 4 at most, and the moving average over the window T by f |w - u|, where with a speed r' of at most v at
// the corner and an acceleration r'' of at most A
//     f = min(v T / 8 + A T^2 / 48, (v + A T)^2 T^2 / (48 d)).
// (The mean of a path whose q' jumps by w - u is off it by (w - u) times the mean of how far it is beyond the corner,
// less how far the mean is: at most half the mean distance from the middle; and over a parabola by the variance / 4 d.)
// What a displacement c of the joints is to the ball: |J c| at the point, and no more than
// (turning on the way there) * (sum of R_j |c_j|) beside it, as everywhere that J is used away from the point.
#pragma once

#include <algorithm>
#include <stop_token>
#include <vector>

#include "core/base/error.hpp"
#include "core/law/time_law.hpp"
#include "core/timing/demand/motion_limits.hpp"
#include "core/timing/path_tool.hpp"
#include "core/timing/plan_path.hpp"

namespace sculpt {

/// What a corner's speeds may be at most, by r, with the accelerations that it was made for.
struct CornerCaps {
  float before = 0, after = 0;  ///< where the parabola begins and ends: between, 1/speed is linear
  float cap = 0;                ///< all along it, for another reason; 0: rest
  bool straight = false;        ///< the edges go on as one: no parabola is needed
};

/// One a point of the path, with that of home.
struct Corners {
  std::vector<LawCorner> law;
  std::vector<CornerCaps> caps;
};

struct Feeds {
  double feed_m_s = 0, rapid_m_s = 0;

  /// On an edge, with this tool.
  double of(const PlanPath::Edge& edge, const PathTool& tool) const {
    return edge.cut ? std::min(feed_m_s, tool.feed_m_s) : rapid_m_s;
  }
};

/// What all corners are made with.
struct CornerDemands {
  const MotionLimits& limits;
  const Configuration& acceleration;  ///< of the law
  double window_s;
  Feeds feeds;
  std::stop_token stop = {};

  /// Throws Cancelled where a stop was requested. For every point.
  void go_on_from(std::size_t point) const {
    constexpr std::size_t points_between = 1024;
    if (point % points_between == 0 && stop.stop_requested()) throw Cancelled{};
  }
};

/// All but x. At home, at the last point and where tools are changed the motion is at rest.
Corners find_corners(const PlanPath& path, const PathTools& tools, const CornerDemands& demands);

}  // namespace sculpt
