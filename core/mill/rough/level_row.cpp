#include "core/mill/rough/level_row.hpp"

#include <algorithm>

namespace sculpt {

bool are_near(const LevelRow& one, const LevelRow& other, double near_m) {
  return std::ranges::any_of(one.points, [&](const Point2& p) {
    return std::ranges::any_of(other.points, [&](const Point2& q) { return (p - q).squaredNorm() < near_m * near_m; });
  });
}

void turn_towards(LevelRow& row, const Point2& at) {
  const auto far = [&](const Point2& p) { return (p - at).squaredNorm(); };
  if (row.is_closed) {
    row.points.pop_back();
    std::rotate(row.points.begin(), std::ranges::min_element(row.points, {}, far), row.points.end());
    row.points.push_back(row.points.front());
  } else if (far(row.points.back()) < far(row.points.front())) {
    std::ranges::reverse(row.points);
  }
}

}  // namespace sculpt
