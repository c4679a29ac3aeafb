#include "core/mill/finish/rows/simplified_curve.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace sculpt {
namespace {

double distance_to_way(const Point2& at, const Point2& from, const Point2& to) {
  const Point2 way = to - from;
  const double length2 = way.squaredNorm();
  const double share = length2 > 0 ? std::clamp((at - from).dot(way) / length2, 0.0, 1.0) : 0;
  return (at - from - share * way).norm();
}

}  // namespace

Curve simplified(const Curve& curve, double off_m) {
  if (curve.size() < 3) return curve;
  std::vector<char> stays(curve.size());
  stays.front() = stays.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> parts{{0, curve.size() - 1}};
  if (curve.front() == curve.back()) {
    const std::size_t middle = curve.size() / 2;
    stays[middle] = 1;
    parts = {{0, middle}, {middle, curve.size() - 1}};
  }
  while (!parts.empty()) {
    const auto [first, last] = parts.back();
    parts.pop_back();
    double farthest = off_m;
    std::size_t corner = 0;
    for (std::size_t at = first + 1; at < last; ++at)
      if (const double off = distance_to_way(curve[at], curve[first], curve[last]); off > farthest)
        farthest = off, corner = at;
    if (corner == 0) continue;
    stays[corner] = 1;
    parts.insert(parts.end(), {{first, corner}, {corner, last}});
  }
  Curve left;
  for (std::size_t at = 0; at < curve.size(); ++at)
    if (stays[at] != 0) left.push_back(curve[at]);
  return left;
}

}  // namespace sculpt
