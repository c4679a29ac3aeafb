// How long each edge of a plan takes from rest to rest: for controllers that stop at every keyframe.
#pragma once

#include <functional>

#include "core/timing/corners.hpp"

namespace sculpt {

struct StopTime {
  double seconds = 0;
  double share = 0;  ///< of the velocity of the joint that is nearest to its own, at the largest speed
};

/// `take` is called for each point but home, in order. Keeps velocity, acceleration and the feed; a controller has
/// ramps of its own for the jerk.
void for_each_stop(const PlanPath& path, const PathTools& tools, const MotionLimits& limits, const Feeds& feeds,
                   const std::function<void(std::size_t point, const StopTime&)>& take);

}  // namespace sculpt
