#include "core/timing/room/highest_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

/// Of a shape in a frame, the largest z.
double highest(const Shape& shape, const Frame& pose) {
  const Frame at = pose * shape.pose;
  const Vec3 up = at.linear().row(2).transpose();
  const double z = at.translation().z();
  switch (shape.kind) {
    case ShapeKind::sphere:
      return z + shape.radius_m;
    case ShapeKind::box:
      return z + up.cwiseAbs().dot(shape.sides_m) / 2;
    case ShapeKind::cylinder:
      return z + std::abs(up.z()) * shape.length_m / 2 + up.head<2>().norm() * shape.radius_m;
    case ShapeKind::mesh:
      break;
  }
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : shape.mesh->vertices) most = std::max(most, (at * vertex).z());
  return most;
}

}  // namespace

double highest_point(const Cell& cell, int link, const std::vector<Frame>& poses) {
  const auto at = static_cast<std::size_t>(link);
  double most = -std::numeric_limits<double>::infinity();
  for (const Shape& shape : cell.robot.links[at].shapes) most = std::max(most, highest(shape, poses[at]));
  return most;
}

}  // namespace sculpt
