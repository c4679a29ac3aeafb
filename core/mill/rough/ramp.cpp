#include "core/mill/rough/ramp.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

constexpr double max_slope = 0.15;
constexpr int max_laps = 20;

}  // namespace

std::vector<Vec3> ramp_along(const Curve& curve, bool is_closed, double top, double bottom, double slot_m) {
  double length = 0;
  for (std::size_t at = 0; at + 1 < curve.size(); ++at) length += (curve[at + 1] - curve[at]).norm();
  const double deep = top - bottom, most = std::min(is_closed ? slot_m : slot_m / 2, max_slope * length);
  if (deep <= 0 || deep > max_laps * most) return {};
  const auto laps = static_cast<int>(std::ceil(deep / most));
  std::vector<Vec3> places{{curve.front().x(), curve.front().y(), top}};
  Curve points = curve;
  double so_far = 0;
  for (int lap = 0; lap <= laps; ++lap) {
    for (std::size_t at = 0; at + 1 < points.size(); ++at) {
      so_far += (points[at + 1] - points[at]).norm();
      const double height = lap < laps ? top - deep * so_far / (laps * length) : bottom;
      places.emplace_back(points[at + 1].x(), points[at + 1].y(), std::max(bottom, height));
    }
    if (!is_closed) std::ranges::reverse(points);
  }
  return places;
}

}  // namespace sculpt
