// Speeds over a part of a parabola on which r'' is constant. Internal to core/timing.
//
// With x = r'^2 and s = r'' a joint's acceleration is q' s + q'' x, and on the part q' and x are linear in r, q'' and s
// constant: the acceleration is linear too, and within its limit everywhere if it is at both ends. With x_1 = x_0 + 2 s
// delta both ends ask of (s, x_0) to lie in bands |alpha s + beta x_0| <= 1: a convex polygon.
#pragma once

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
  using Bands = Eigen::Array<double, Eigen::Dynamic, 1, 0, 2 * max_joints + 1, 1>;
  /// Of s at x_0, by bands alone.
  double upper(double start) const { return (reach_ - slope_ * start).minCoeff(); }
  double lower(double start) const { return (-reach_ - slope_ * start).maxCoeff(); }
  Eigen::Index binding_upper(double start) const;
  Eigen::Index binding_lower(double start) const;

  Bands reach_, slope_;  ///< first those of the joints at its beginning, then at its end, then that of s itself
  double delta_, max_start_;
};

}  // namespace sculpt
