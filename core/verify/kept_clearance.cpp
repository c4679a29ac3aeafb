#include "core/verify/kept_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {

KeptClearance::KeptClearance(const LinkMotion& motion, const Around& first, const Around& second) {
  sides_.push_back({first, motion.joints_between(second.link, first.link), {}});
  if (second.radius >= 0) sides_.push_back({second, motion.joints_between(first.link, second.link), {}});
}

void KeptClearance::move_anchor(const Configuration& at, const std::vector<Frame>& poses) {
  anchor_ = at;
  clearance_ = 0;
  for (Side& side : sides_) {
    const Vec3 centre = poses[static_cast<std::size_t>(side.thing.link)] * side.thing.centre;
    side.arms = lever_arms(side.joints, poses, centre, side.thing.radius);
  }
}

double KeptClearance::approach(const Side& side, const JointMotion& motion) const {
  return motion_limit(side.joints, side.arms, [&](int coordinate) {
    const double start = motion.from[coordinate] - anchor_[coordinate];
    return std::max(std::abs(start), std::abs(start + motion.step[coordinate]));
  });
}

// What either one sees of the other bounds the approach; the smaller bound holds.
double KeptClearance::approach(const JointMotion& motion) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Side& side : sides_) least = std::min(least, approach(side, motion));
  return least;
}

bool KeptClearance::covers(const JointMotion& motion) const {
  if (clearance_ <= 0) return false;
  return std::any_of(sides_.begin(), sides_.end(),
                     [&](const Side& side) { return approach(side, motion) <= clearance_; });
}

double KeptClearance::approach(const std::vector<Frame>& poses, const Configuration& steps) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Side& side : sides_) {
    const Vec3 centre = poses[static_cast<std::size_t>(side.thing.link)] * side.thing.centre;
    least = std::min(least, motion_limit(side.joints, poses, steps, centre, side.thing.radius));
  }
  return least;
}

bool KeptClearance::moved_by(const JointMotion& motion) const {
  for (const MovingJoint& joint : sides_.front().joints)
    if (motion.step[joint.coordinate] != 0) return true;
  return false;
}

}  // namespace sculpt
