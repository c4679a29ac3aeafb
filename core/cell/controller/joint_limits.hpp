// How fast a joint may move, and how fast that may change.
#pragma once

namespace sculpt {

/// rad or m, and seconds. 0 = not given.
struct JointLimits {
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
};

}  // namespace sculpt
