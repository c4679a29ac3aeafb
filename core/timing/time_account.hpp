// Where the time of a plan goes.
#pragma once

#include <vector>

namespace sculpt {

/// Seconds; by coordinate where it is a joint's limit.
struct TimeAccount {
  double total = 0;
  double at_caps = 0;  ///< what it would be if all were gone through at the speeds that feed, rapid and joints allow
  double feed = 0, rapid = 0;
  std::vector<double> velocity, acceleration, jerk;
  std::vector<double> tools;  ///< with each milling tool of the plan in the spindle
};

}  // namespace sculpt
