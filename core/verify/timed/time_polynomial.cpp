#include "core/verify/timed/time_polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {

// At the ends, and where the acceleration is zero in between.
Configuration TimePolynomial::max_velocity() const {
  Configuration most = velocity(0).cwiseAbs().cwiseMax(velocity(seconds).cwiseAbs());
  for (Eigen::Index joint = 0; joint < most.size(); ++joint) {
    const double a = 12 * c[4][joint], b = 6 * c[3][joint], d = 2 * c[2][joint];
    const auto look_at = [&](double t) {
      if (t > 0 && t < seconds) most[joint] = std::max(most[joint], std::abs(velocity(t)[joint]));
    };
    if (a == 0) {
      if (b != 0) look_at(-d / b);
      continue;
    }
    const double square = b * b - 4 * a * d;
    if (square < 0) continue;
    const double root = std::sqrt(square);
    look_at((-b + root) / (2 * a));
    look_at((-b - root) / (2 * a));
  }
  return most;
}

// At the ends, and at the parabola's vertex.
Configuration TimePolynomial::max_acceleration() const {
  Configuration most = acceleration(0).cwiseAbs().cwiseMax(acceleration(seconds).cwiseAbs());
  for (Eigen::Index joint = 0; joint < most.size(); ++joint) {
    const double a = 12 * c[4][joint], b = 6 * c[3][joint];
    const double t = a == 0 ? -1 : -b / (2 * a);
    if (t > 0 && t < seconds) most[joint] = std::max(most[joint], std::abs(acceleration(t)[joint]));
  }
  return most;
}

}  // namespace sculpt
