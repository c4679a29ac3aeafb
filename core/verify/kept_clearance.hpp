// How far two things were apart once, and whether they can have met since. Internal to verify/. Millimetres.
#pragma once

#include <vector>

#include "core/verify/replay_finding.hpp"
#include "core/verify/robot/link_motion.hpp"

namespace sculpt {

/// A point set around a centre that is fixed to a link.
struct Around {
  int link = -1;
  Vec3 centre = Vec3::Zero();  ///< in the link's frame
  double radius = 0;
};

/// A clearance proved at one configuration (the anchor). It holds at every later one that is nearer to the anchor than
/// the two things need to meet, however long the way between: material only shrinks, links do not change.
class KeptClearance {
 public:
  /// `second` of negative radius: it has no bounds (the material), only the first one's motion counts.
  KeptClearance(const LinkMotion& motion, const Around& first, const Around& second);

  /// Nothing is proved at `at`, where the links are at `poses`, until `prove`.
  void move_anchor(const Configuration& at, const std::vector<Frame>& poses);
  void prove(double clearance_mm) { clearance_ = clearance_mm; }
  void forget() { clearance_ = 0; }
  double proved() const { return clearance_; }

  /// Bound on how much nearer to each other the two are, anywhere on the motion, than at the anchor.
  double approach(const JointMotion& motion) const;
  /// The same, for coordinates that move by no more than `steps` from where `poses` are.
  double approach(const std::vector<Frame>& poses, const Configuration& steps) const;
  bool covers(const JointMotion& motion) const;

  /// Whether the motion moves one of the two against the other.
  bool moved_by(const JointMotion& motion) const;

 private:
  struct Side {
    Around thing;
    std::vector<MovingJoint> joints;  // from the other thing to this one
    std::vector<double> arms;         // at the anchor
  };

  double approach(const Side& side, const JointMotion& motion) const;

  std::vector<Side> sides_;
  Configuration anchor_;
  double clearance_ = 0;
};

}  // namespace sculpt
