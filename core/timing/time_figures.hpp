// A timed plan in figures: what `sculpt time` and a job's report say of it.
#pragma once

#include "core/timing/timed_plan.hpp"

namespace sculpt {

struct TimeFigures {
  TimeAccount time;     ///< s
  double window_s = 0;  ///< of the moving average
  double feed_m_s = 0, rapid_m_s = 0;
  std::uint64_t keyframes = 0;
  std::vector<std::string> joints;  ///< whose the account's limits are
  std::vector<std::string> tools;   ///< whose the account's times are; none for a thin tool
  std::vector<SlowPlace> worst;     ///< of the cuts, the slowest first

  /// To what feed, rapid and the joints' velocities alone would take.
  double ratio() const { return time.at_caps > 0 ? time.total / time.at_caps : 1; }
};

TimeFigures time_figures(const PlanPath& path, const TimedPlan& plan);

/// One JSON object: {total_s, ratio, window_s, feed_m_s, rapid_m_s, keyframes, by{feed, rapid, velocity{},
/// acceleration{}, jerk{}}, worst[{keyframe, voxel, joint, feed_m_s}], tools[{name, seconds}]?}.
std::string time_json(const TimeFigures& figures);

}  // namespace sculpt
