#include "core/verify/kept_clearance.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {

void KeptClearance::move_anchor(const Configuration& at, const std::vector<Frame>& poses) {
  anchor_ = at;
  clearance_ = 0;
  arms_ = bound_.arms(poses);
}

double KeptClearance::approach(const JointMotion& motion) const {
  return bound_.at(arms_, [&](int coordinate) {
    const double start = motion.from[coordinate] - anchor_[coordinate];
    return std::max(std::abs(start), std::abs(start + motion.step[coordinate]));
  });
}

bool KeptClearance::covers(const JointMotion& motion) const {
  return clearance_ > 0 && approach(motion) <= clearance_;
}

}  // namespace sculpt
