// When the joints of a plan are where: what `sculpt time` finds, and what samples and programs are made from.
//
// An edge is the straight way from one keyframe to the next. Its length is e = sqrt(sum of (dq_j / a_j)^2), a_j the
// law's accelerations; r is the way gone by that measure, and x = (dr/dt)^2. At a keyframe the corner is cut off by a
// parabola: from `half` before it to `half` after it q' goes linearly from that of the one edge to that of the other.
//
//      --- line ---\.                 x_in at half before, x_mid at the middle, x_out at half after; between these
//                    `--. parabola    x is linear in r. On the line from x_out to the next x_in it rises with the
//                        `\           acceleration 1 / max_j |q'_j| / a_j to cruise^2 at most, and falls as fast.
//                          \ line
//
// What a controller is to do is the moving average over `window_s` of that motion: q(t) is the mean of it from
// t - window_s to t, so it begins and ends at rest and lasts window_s longer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/frame.hpp"

namespace sculpt {

/// At a keyframe, and on the edge that leads to it. Of a keyframe that is where the one before it is all are 0: it is
/// passed over, and the corner is with the first of the two.
struct LawCorner {
  float half = 0;    ///< 0: no parabola; with x_mid = 0 too the motion rests there for window_s
  float cruise = 0;  ///< largest dr/dt on the edge
  float x_in = 0, x_mid = 0, x_out = 0;
};

struct TimeLaw {
  std::vector<double> acceleration;  ///< a_j, one a coordinate of the plan
  double window_s = 0;
  double feed_m_s = 0, rapid_m_s = 0;  ///< what was asked for
  std::vector<LawCorner> corners;      ///< one a keyframe of the plan
};

}  // namespace sculpt
