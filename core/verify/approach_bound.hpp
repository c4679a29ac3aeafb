// How much nearer to each other two things come while coordinates move. Internal to verify/. Millimetres.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "core/verify/findings/replay_finding.hpp"
#include "core/verify/robot/link_motion.hpp"

namespace sculpt {

/// A point set around a centre that is fixed to a link.
struct Around {
  int link = -1;
  Vec3 centre = Vec3::Zero();  ///< in the link's frame
  double radius = 0;
};

/// What either one sees of the other bounds the approach; the smaller bound holds.
class ApproachBound {
 public:
  /// `second` of negative radius: it has no bounds (the material), only the first one's motion counts.
  ApproachBound(const LinkMotion& motion, const Around& first, const Around& second);

  /// Distances from the axes, by side and joint.
  using Arms = std::vector<std::vector<double>>;
  Arms arms(const std::vector<Frame>& poses) const;

  /// While coordinate c moves by no more than `step_of(c)` from where the arms are these.
  template <typename StepOf>
  double at(const Arms& arms, const StepOf& step_of) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t side = 0; side < sides_.size(); ++side)
      least = std::min(least, motion_limit(sides_[side].joints, arms[side], step_of));
    return least;
  }

  /// While coordinates move by no more than `steps` from where `poses` are.
  double at(const std::vector<Frame>& poses, const Configuration& steps) const;

  /// Whether the motion moves one of the two against the other.
  bool moved_by(const JointMotion& motion) const;

  /// The joints between the two.
  const std::vector<MovingJoint>& joints() const { return sides_.front().joints; }

 private:
  struct Side {
    Around thing;
    std::vector<MovingJoint> joints;  // from the other thing to this one
  };

  std::vector<Side> sides_;
};

}  // namespace sculpt
