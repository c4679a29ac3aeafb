// How far two things were apart once, and whether they can have met since. Internal to verify/. Millimetres.
#pragma once

#include <utility>

#include "core/verify/approach_bound.hpp"

namespace sculpt {

/// A clearance proved at one configuration (the anchor). It holds at every later one that is nearer to the anchor than
/// the two things need to meet, however long the way between: material only shrinks, links do not change.
class KeptClearance {
 public:
  explicit KeptClearance(ApproachBound bound) : bound_(std::move(bound)) {}

  const ApproachBound& bound() const { return bound_; }

  /// Nothing is proved at `at`, where the links are at `poses`, until `prove`.
  void move_anchor(const Configuration& at, const std::vector<Frame>& poses);
  void prove(double clearance_mm) { clearance_ = clearance_mm; }
  void forget() { clearance_ = 0; }
  double proved() const { return clearance_; }

  /// Bound on how much nearer to each other the two are, anywhere on the motion, than at the anchor.
  double approach(const JointMotion& motion) const;
  bool covers(const JointMotion& motion) const;

 private:
  ApproachBound bound_;
  Configuration anchor_;
  ApproachBound::Arms arms_;  // at the anchor
  double clearance_ = 0;
};

}  // namespace sculpt
