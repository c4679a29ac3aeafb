// A neighbourhood of a configuration in which nothing that moves touches anything: one set of distance queries for many
// edges (Quinlan, "Real-time modification of collision-free paths", 1994).
#pragma once

#include <vector>

#include "core/cell/chain.hpp"

namespace sculpt {

/// A box of joint values less what a few pairs of bodies cut off. The set is convex, so an edge is free all along if
/// both of its ends are held. Immutable.
class Bubble {
 public:
  /// A capsule that approaches something: first derivatives, at the centre, of its ends (m per unit of each joint) and
  /// of its turning (rad), seen from the other body.
  struct Approach {
    Eigen::Matrix<double, 3, Eigen::Dynamic> end_a, end_b, turn;
    double radius_m;  ///< of the capsule
    double room_m;    ///< how far it may move; what derivatives of higher order add within the box is taken off already
  };

  /// Holds nothing.
  Bubble() = default;
  /// Within `half` of `centre`, joint by joint, everything is free if each of `approaches` keeps to its room.
  Bubble(Configuration centre, Configuration half, const std::vector<Approach>& approaches)
      : centre_(std::move(centre)), half_(std::move(half)) {
    rows_.resize(static_cast<Eigen::Index>(9 * approaches.size()), centre_.size());
    for (std::size_t at = 0; at < approaches.size(); ++at) {
      const Approach& approach = approaches[at];
      rows_.middleRows<9>(static_cast<Eigen::Index>(9 * at)) << approach.end_a, approach.end_b, approach.turn;
      rooms_.push_back({approach.radius_m, approach.room_m});
    }
  }

  bool empty() const { return centre_.size() == 0; }
  bool holds(const Configuration& q) const {
    if (q.size() != centre_.size()) return false;
    const Configuration step = q - centre_;
    if ((step.cwiseAbs().array() > half_.array()).any()) return false;
    const Eigen::VectorXd moved = rows_ * step;
    for (std::size_t at = 0; at < rooms_.size(); ++at) {
      const auto row = static_cast<Eigen::Index>(9 * at);
      const double ends = std::max(moved.segment<3>(row).norm(), moved.segment<3>(row + 3).norm());
      if (ends + rooms_[at].radius_m * moved.segment<3>(row + 6).norm() >= rooms_[at].room_m) return false;
    }
    return true;
  }

 private:
  struct Room {
    double radius_m, room_m;
  };

  Configuration centre_, half_;
  Eigen::MatrixXd rows_;  ///< 9 for each approach
  std::vector<Room> rooms_;
};

}  // namespace sculpt
