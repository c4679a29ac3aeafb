#include "core/timing/demand/motion_limits.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace sculpt {

MotionLimits limits_of(const Cell& cell, const Chain& chain) {
  const Eigen::Index dof = chain.dof();
  MotionLimits limits{Configuration(dof), Configuration(dof), Configuration(dof)};
  for (Eigen::Index c = 0; c < dof; ++c) {
    const int leader = chain.joints()[static_cast<std::size_t>(c)];
    const JointLimits& own = cell.limits[static_cast<std::size_t>(leader)];
    const std::string& name = cell.robot.joints[static_cast<std::size_t>(leader)].name;
    if (!(own.acceleration > 0) || !(own.jerk > 0))
      throw InputError("limits_missing", "the cell has no acceleration and jerk for joint '" + name +
                                             "': give it \"limits\": {\"" + name +
                                             "\": {\"acceleration\": ..., \"jerk\": ...}} as its maker publishes them");
    if (!(own.velocity > 0))
      throw InputError("limits_missing", "neither the URDF nor the cell has a velocity for joint '" + name +
                                             "': give it \"limits\": {\"" + name + "\": {\"velocity\": ...}}");
    limits.velocity[c] = own.velocity;
    limits.acceleration[c] = own.acceleration;
    limits.jerk[c] = own.jerk;
    for (const Joint& follower : cell.robot.joints)
      if (follower.mimic == leader && follower.max_speed > 0 && follower.mimic_multiplier != 0)
        limits.velocity[c] = std::min(limits.velocity[c], follower.max_speed / std::abs(follower.mimic_multiplier));
  }
  return limits;
}

}  // namespace sculpt
