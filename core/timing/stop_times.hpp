// How long each edge of a plan takes from rest to rest: for controllers that stop at every keyframe.
#pragma once

#include <functional>

#include "core/timing/corners.hpp"

namespace sculpt {

struct StopTime {
  double seconds = 0;
  double share = 0;  ///< of the velocity of the joint that is nearest to its own, at the largest speed
};

/// Of one edge, `tool` in the spindle, the ball no faster than `feed_m_s`. the tool is at `from` already, places.end is
/// set.
StopTime stop_time(const PathTool& tool, const MotionLimits& limits, double feed_m_s, const Configuration& from,
                   const Configuration& to, EdgePlaces& places);

/// `take` is called for each point but home, in order. Keeps velocity, acceleration and the feed; a controller has
/// ramps of its own for the jerk.
void for_each_stop(const PlanPath& path, const PathTools& tools, const MotionLimits& limits, const Feeds& feeds,
                   const std::function<void(std::size_t point, const StopTime&)>& take);

}  // namespace sculpt
