#include "core/verify/approach_bound.hpp"

#include <cmath>

namespace sculpt {

ApproachBound::ApproachBound(const LinkMotion& motion, const Around& first, const Around& second) {
  sides_.push_back({first, motion.joints_between(second.link, first.link)});
  if (second.radius >= 0) sides_.push_back({second, motion.joints_between(first.link, second.link)});
}

ApproachBound::Arms ApproachBound::arms(const std::vector<Frame>& poses) const {
  Arms arms;
  for (const Side& side : sides_) {
    const Vec3 centre = poses[static_cast<std::size_t>(side.thing.link)] * side.thing.centre;
    arms.push_back(lever_arms(side.joints, poses, centre, side.thing.radius));
  }
  return arms;
}

double ApproachBound::at(const std::vector<Frame>& poses, const Configuration& steps) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Side& side : sides_) {
    const Vec3 centre = poses[static_cast<std::size_t>(side.thing.link)] * side.thing.centre;
    least = std::min(least, motion_limit(side.joints, poses, steps, centre, side.thing.radius));
  }
  return least;
}

bool ApproachBound::moved_by(const JointMotion& motion) const {
  return std::ranges::any_of(joints(), [&](const MovingJoint& joint) { return motion.step[joint.coordinate] != 0; });
}

}  // namespace sculpt
