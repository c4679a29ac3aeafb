// How the joints move over a piece of time: polynomials of the fourth degree. Internal to verify/.
#pragma once

#include <array>

#include "core/base/frame.hpp"

namespace sculpt {

/// q(t) = c[0] + c[1] t + ... + c[4] t^4 from t = 0 at `begin_s` on, for `seconds`.
struct TimePolynomial {
  double begin_s = 0, seconds = 0;
  std::array<Configuration, 5> c;
  std::uint64_t keyframe = 0;            ///< it leads there, or turns there
  bool cut = false;                      ///< and ball and shank are in the material
  double gone = 0, speed = 0, rise = 0;  ///< r(t) = gone + speed t + rise t^2 / 2, r as the law measures the way

  double end_s() const { return begin_s + seconds; }
  Configuration place(double t) const { return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4]))); }
  Configuration velocity(double t) const { return c[1] + t * (2 * c[2] + t * (3 * c[3] + t * 4 * c[4])); }
  Configuration acceleration(double t) const { return 2 * c[2] + t * (6 * c[3] + t * 12 * c[4]); }
  /// Of the place, from 0 to t.
  Configuration integral(double t) const {
    return t * (c[0] + t * (c[1] / 2 + t * (c[2] / 3 + t * (c[3] / 4 + t * c[4] / 5))));
  }
  /// Of r, from 0 to t.
  double gone_integral(double t) const { return t * (gone + t * (speed / 2 + t * rise / 6)); }
  /// Largest of each joint, either way, over the piece: exact.
  Configuration max_velocity() const;
  Configuration max_acceleration() const;
};

}  // namespace sculpt
