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

/// A box of joint values less what a few pairs of bodies cut off. The set is convex, so an edge is free all along if
/// both of its ends are held.
class Bubble {
 public:
  /// A capsule that approaches something: first derivatives, at the centre, of its ends (m per unit of each joint) and
  /// of its turning (rad), seen from the other body.
  struct Approach {
    JointColumns<3> end_a, end_b, turn;
    double radius_m;  ///< of the capsule
    double room_m;    ///< how far it may move; what derivatives of higher order add within the box is taken off already
  };

  /// A capsule and a plane between it and something convex: per unit of each joint, how far its ends come nearer to the
  /// plane (m), and how far they may.
  struct Advance {
    Configuration end_a, end_b;
    double room_m;
  };

  /// Holds nothing.
  Bubble() = default;
  /// Within `box` everything is free if each of `approaches` and `advances`, seen from `centre`, keeps to its room.
  Bubble(Configuration centre, JointBox box, const std::vector<Approach>& approaches, std::vector<Advance> advances)
      : centre_(std::move(centre)), box_(std::move(box)), advances_(std::move(advances)) {
    const Eigen::Index joints = centre_.size();
    motions_.resize(9, static_cast<Eigen::Index>(approaches.size()) * joints);
    for (const Approach& approach : approaches) {
      motions_.middleCols(first_column(rooms_.size()), joints) << approach.end_a, approach.end_b, approach.turn;
      rooms_.push_back({approach.radius_m, approach.room_m});
    }
  }

  /// To where everything is as it is here, but for the joint values.
  void shift(const Configuration& by) {
    centre_ += by;
    box_ = box_.shifted(by);
  }

  bool empty() const { return centre_.size() == 0; }
  bool holds(const Configuration& q) const {
    if (q.size() != centre_.size()) return false;
    Configuration step(q.size());
    bool in_box = true;
    for (Eigen::Index joint = 0; joint < q.size(); ++joint) {
      in_box &= q[joint] >= box_.low[joint] && q[joint] <= box_.high[joint];
      step[joint] = q[joint] - centre_[joint];
    }
    if (!in_box) return false;
    for (const Advance& advance : advances_) {
      double by_a = 0, by_b = 0;
      for (Eigen::Index joint = 0; joint < step.size(); ++joint) {
        by_a += advance.end_a[joint] * step[joint];
        by_b += advance.end_b[joint] * step[joint];
      }
      if (std::max(by_a, by_b) >= advance.room_m) return false;
    }
    for (std::size_t at = 0; at < rooms_.size(); ++at) {
      Eigen::Matrix<double, 9, 1> moved = motions_.col(first_column(at)) * step[0];
      for (Eigen::Index joint = 1; joint < step.size(); ++joint)
        moved += motions_.col(first_column(at) + joint) * step[joint];
      const double ends = std::max(moved.segment<3>(0).norm(), moved.segment<3>(3).norm());
      if (ends + rooms_[at].radius_m * moved.segment<3>(6).norm() >= rooms_[at].room_m) return false;
    }
    return true;
  }

 private:
  struct Room {
    double radius_m, room_m;
  };

  Eigen::Index first_column(std::size_t approach) const { return static_cast<Eigen::Index>(approach) * centre_.size(); }

  Configuration centre_;
  JointBox box_;
  Eigen::Matrix<double, 9, Eigen::Dynamic> motions_;  ///< of all approaches, side by side: end_a, end_b, turn
  std::vector<Room> rooms_;
  std::vector<Advance> advances_;
};

}  // namespace sculpt
