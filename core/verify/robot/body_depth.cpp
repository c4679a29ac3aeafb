#include "core/verify/robot/body_depth.hpp"

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

// Along each side of the box around a body, ends included.
constexpr int points_a_side = 5;

}  // namespace

double depth_in(const SolidBody& body, const Vec3& point) {
  switch (body.kind) {
    case ShapeKind::sphere:
      return body.half.x() - point.norm();
    case ShapeKind::box:
      return (body.half - point.cwiseAbs()).minCoeff();
    case ShapeKind::cylinder:
      return std::min(body.half.x() - std::hypot(point.x(), point.y()), body.half.z() - std::abs(point.z()));
    case ShapeKind::mesh:
      break;
  }
  return -1;
}

std::vector<Vec3> points_of(const SolidBody& body) {
  std::vector<Vec3> points;
  if (body.kind == ShapeKind::mesh) return points;
  const auto part = [](int step) { return 2.0 * step / (points_a_side - 1) - 1; };
  for (int i = 0; i < points_a_side; ++i)
    for (int j = 0; j < points_a_side; ++j)
      for (int k = 0; k < points_a_side; ++k) {
        const Vec3 point = body.half.cwiseProduct(Vec3(part(i), part(j), part(k)));
        if (depth_in(body, point) >= 0) points.push_back(point);
      }
  return points;
}

}  // namespace sculpt
