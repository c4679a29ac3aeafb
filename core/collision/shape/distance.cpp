#include "core/collision/shape/distance.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

/// How far x lies outside [low, high], signed: negative below, positive above, 0 inside.
double excess(double x, double low, double high) {
  if (x < low) return x - low;
  if (x > high) return x - high;
  return 0;
}

}  // namespace

Vec3 separation(const Segment& first, const Segment& second) {
  const Vec3 d1 = first.b - first.a, d2 = second.b - second.a, r = first.a - second.a;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r);
  constexpr double tiny = 1e-24;
  double s = 0, t = 0;
  if (a <= tiny && e <= tiny) return r;
  if (a <= tiny) {
    t = std::clamp(f / e, 0.0, 1.0);
  } else {
    const double c = d1.dot(r);
    if (e <= tiny) {
      s = std::clamp(-c / a, 0.0, 1.0);
    } else {
      const double b = d1.dot(d2), det = a * e - b * b;
      if (det > 0) s = std::clamp((b * f - c * e) / det, 0.0, 1.0);
      t = (b * s + f) / e;
      if (t < 0) {
        t = 0;
        s = std::clamp(-c / a, 0.0, 1.0);
      } else if (t > 1) {
        t = 1;
        s = std::clamp((b - c) / a, 0.0, 1.0);
      }
    }
  }
  return first.a + s * d1 - second.a - t * d2;
}

Vec3 separation_from_box(const Segment& segment, const Vec3& low, const Vec3& high) {
  // The squared distance of a + t d to the box is convex in t with half slope sum_i d_i excess_i(t): rising and linear
  // between the corners where a coordinate passes a face. Corners narrow [from, to] around the point where the slope
  // passes zero.
  const Vec3 d = segment.b - segment.a;
  const auto slope = [&](double t) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += d[axis] * excess(segment.a[axis] + t * d[axis], low[axis], high[axis]);
    return sum;
  };
  double from = 0, to = 1, slope_from = slope(0), slope_to = slope(1);
  double best = 0;
  if (slope_from < 0 && slope_to <= 0) {
    best = 1;
  } else if (slope_from < 0) {
    for (int axis = 0; axis < 3; ++axis) {
      if (d[axis] == 0) continue;
      for (double face : {low[axis], high[axis]}) {
        const double t = (face - segment.a[axis]) / d[axis];
        if (t <= from || t >= to) continue;
        const double here = slope(t);
        (here < 0 ? from : to) = t;
        (here < 0 ? slope_from : slope_to) = here;
      }
    }
    best = from + (to - from) * slope_from / (slope_from - slope_to);
  }
  Vec3 out;
  for (int axis = 0; axis < 3; ++axis) out[axis] = excess(segment.a[axis] + best * d[axis], low[axis], high[axis]);
  return out;
}

}  // namespace sculpt
