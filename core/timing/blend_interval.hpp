// Speeds over a part of a parabola on which r'' is constant. Internal to core/timing.
//
// With x = r'^2 and s = r'' a joint's acceleration is q' s + q'' x, and on the part q' and x are linear in r, q'' and s
// constant: the acceleration is linear too, and within its limit everywhere if it is at both ends. With x_1 = x_0 + 2 s
// delta both ends ask of (s, x_0) to lie in bands |alpha s + beta x_0| <= 1: a convex polygon.
#pragma once

#include <array>

#include "core/base/frame.hpp"

namespace sculpt {

class BlendInterval {
 public:
  /// q' at its beginning and q'', both divided by the joints' accelerations; its length; the largest |s|.
  BlendInterval(const Configuration& way, const Configuration& bend, double delta, double most);

  /// The largest x_0 up to `cap` from which some x_1 of at most `end` can be come to.
  double max_start(double cap, double end) const;
  /// The largest x_1 up to `end` that can be come to from `start`, which is no more than `max_start`.
  double max_end(double start, double end) const;
  /// The joint whose acceleration binds there, or -1: `most` does, or `end`.
  int binding(double start) const;

 private:
  struct Line {
    double value, slope;
    int joint;
  };
  /// Of s at x_0: bands alone.
  Line upper(double start) const;
  Line lower(double start) const;
  void add(double alpha, double beta, int joint);

  std::array<double, 2 * max_joints + 1> reach_, slope_;
  std::array<int, 2 * max_joints + 1> joint_;
  int bands_ = 0;
  double delta_, max_start_;
};

}  // namespace sculpt
