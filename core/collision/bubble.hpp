// A neighbourhood of a configuration in which nothing that moves touches anything: one set of distance queries for many
// edges (Quinlan, "Real-time modification of collision-free paths", 1994).
#pragma once

#include <vector>

#include "core/cell/chain.hpp"

namespace sculpt {

/// Configurations between two, joint by joint, both included.
struct JointBox {
  Configuration low, high;

  bool holds(const Configuration& q) const {
    return (q.array() >= low.array()).all() && (q.array() <= high.array()).all();
  }
  bool holds(const JointBox& other) const { return holds(other.low) && holds(other.high); }
  JointBox shifted(const Configuration& by) const { return {low + by, high + by}; }
  Configuration centre() const { return (low + high) / 2; }
  /// How far it goes away from q, joint by joint.
  Configuration reach_from(const Configuration& q) const { return (high - q).cwiseMax(q - low).cwiseMax(0); }
};

/// A box of joint values less what a few half-spaces cut off. The set is convex, so an edge is free all along if both
/// of its ends are held.
class Bubble {
 public:
  /// A point of a body and a plane between it and something else: per unit of each joint, how far the point comes
  /// nearer to the plane (m), and how far it may.
  struct HalfSpace {
    Configuration approach;
    double room_m;

    bool holds(const Configuration& step) const { return approach.dot(step) < room_m; }
    /// All steps of +-half?
    bool holds_box(const Configuration& half) const { return approach.cwiseAbs().dot(half) < room_m; }
  };

  /// Holds nothing.
  Bubble() = default;
  /// Within `box` everything is free as long as all of `half_spaces`, seen from `centre`, hold.
  Bubble(Configuration centre, JointBox box, std::vector<HalfSpace> half_spaces)
      : centre_(std::move(centre)), box_(std::move(box)), half_spaces_(std::move(half_spaces)) {}

  /// To where everything is as it is here, but for the joint values.
  void shift(const Configuration& by) {
    centre_ += by;
    box_ = box_.shifted(by);
  }

  bool empty() const { return centre_.size() == 0; }
  bool holds(const Configuration& q) const {
    if (q.size() != centre_.size() || !box_.holds(q)) return false;
    const Configuration step = q - centre_;
    for (const HalfSpace& half_space : half_spaces_)
      if (!half_space.holds(step)) return false;
    return true;
  }

  /// For an archive.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(centre_, box_, half_spaces_);
  }

 private:
  Configuration centre_;
  JointBox box_;
  std::vector<HalfSpace> half_spaces_;
};

}  // namespace sculpt
