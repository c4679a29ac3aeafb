// How one link moves as seen from another. Internal to verify/. Millimetres.
#pragma once

#include <vector>

#include "core/base/frame.hpp"

namespace sculpt {

/// The moving joints between two links, and what stands still between those as one frame. Made by LinkMotion.
/// Immutable.
class LinkChain {
 public:
  /// All in the frame of the link that is looked from.
  struct Place {
    struct Axis {
      Vec3 at, way;  ///< a point of it, and its direction
    };
    Frame link = Frame::Identity();
    std::vector<Axis> axes;  ///< of the moving joints, nearest first
  };

  void place(const Configuration& q, Place& place) const;

  /// Bound on how far any point between `a` and `b` (in the far link's frame) strays from the straight way between its
  /// two ends, at the same share of it, while the coordinates move linearly by `step` from `start` to `end`.
  double sagitta(const Place& start, const Place& end, const Configuration& step, const Vec3& a, const Vec3& b) const;

  /// Whether the motion moves the one link against the other.
  bool moved_by(const Configuration& step) const;

  /// Nothing moves the one link against the other, which is there.
  bool is_rigid() const { return hops_.empty(); }
  const Frame& rigid() const { return after_; }

 private:
  friend class LinkMotion;

  struct Hop {
    Frame before;  // from the joint before to this one, its axis as z
    bool turns;
    int coordinate;
    double rate, constant;  // value = rate * coordinate + constant, as it goes from the near side to the far one; in mm
                            // for prismatic joints
  };
  /// How the far link moves at one moment, by a unit of time.
  struct Drive;

  Drive drive(const Place& place, const Configuration& step) const;
  double fourth_derivative(const Place& place, const Configuration& step, const Vec3& a, const Vec3& b) const;

  std::vector<Hop> hops_;
  Frame after_ = Frame::Identity();
};

}  // namespace sculpt
