#include "core/verify/material/convex_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sculpt {
namespace {

/// Taken off every separation of a box: its axes are only nearly at right angles.
constexpr double turn_slack = 1e-9;

/// How far a coordinate is outside [-half, half], with its sign.
double excess(double at, double half) {
  return at > half ? at - half : at < -half ? at + half : 0;
}

}  // namespace

ConvexProbe::Capsule ConvexProbe::capsule(const Frame& pose, double length, double radius) {
  const Vec3 way = length * pose.linear().col(2);
  return {pose.translation() - way / 2, way, radius};
}

ConvexProbe::Box ConvexProbe::box(const Frame& pose, const Vec3& half) {
  return {pose, half, (pose.linear().cwiseAbs().array() + turn_slack).matrix()};
}

std::optional<ConvexProbe> ConvexProbe::of(const fcl::CollisionGeometryd& geometry, const Frame& pose) {
  ConvexProbe probe;
  switch (geometry.getNodeType()) {
    case fcl::GEOM_SPHERE:
      probe.around_ = capsule(pose, 0, static_cast<const fcl::Sphered&>(geometry).radius);
      return probe;
    case fcl::GEOM_CAPSULE: {
      const auto& shape = static_cast<const fcl::Capsuled&>(geometry);
      probe.around_ = capsule(pose, shape.lz, shape.radius);
      return probe;
    }
    case fcl::GEOM_CYLINDER: {
      const auto& shape = static_cast<const fcl::Cylinderd&>(geometry);
      probe.around_ = capsule(pose, shape.lz, shape.radius);
      if (shape.lz > 2 * shape.radius) probe.inside_ = capsule(pose, shape.lz - 2 * shape.radius, shape.radius);
      probe.box_ = box(pose, {shape.radius, shape.radius, shape.lz / 2});
      return probe;
    }
    case fcl::GEOM_BOX:
      probe.box_ = box(pose, static_cast<const fcl::Boxd&>(geometry).side / 2);
      return probe;
    default:
      return std::nullopt;
  }
}

Meeting ConvexProbe::with_cube(const Vec3& centre, double half) const {
  if (around_ && !around_->meets(centre, half)) return Meeting::apart;
  if (box_ && !box_->meets(centre, half)) return Meeting::apart;
  if (!around_ || !box_ || (inside_ && inside_->meets(centre, half))) return Meeting::meet;
  return Meeting::unknown;
}

// The squared distance of the cube from a point that goes along the segment is convex, and a parabola between the times
// at which a coordinate of the point passes a face's plane: its slope is followed to 0.
bool ConvexProbe::Capsule::meets(const Vec3& centre, double half) const {
  const Vec3 start = from - centre;
  const auto slope = [&](double t) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += way[axis] * excess(start[axis] + t * way[axis], half);
    return sum;
  };
  const auto gap2 = [&](double t) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double out = excess(start[axis] + t * way[axis], half);
      sum += out * out;
    }
    return sum;
  };
  double low = 0, high = 1, at_low = slope(0), at_high = slope(1);
  if (at_low >= 0) return gap2(0) <= radius * radius;
  if (at_high <= 0) return gap2(1) <= radius * radius;
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) continue;
    for (const double face : {-half, half}) {
      const double t = (face - start[axis]) / way[axis];
      if (t <= low || t >= high) continue;
      const double at = slope(t);
      (at <= 0 ? low : high) = t;
      (at <= 0 ? at_low : at_high) = at;
    }
  }
  const double rise = at_high - at_low;
  return gap2(rise > 0 ? low - at_low * (high - low) / rise : low) <= radius * radius;
}

// Separating axes: Gottschalk, Lin, Manocha, "OBBTree", 1996, section 5.
bool ConvexProbe::Box::meets(const Vec3& centre, double cube) const {
  const Vec3 between = pose.translation() - centre;
  const Eigen::Matrix3d& rotation = pose.linear();
  if ((between.array().abs() > (turn * half).array() + cube).any()) return false;
  if (((rotation.transpose() * between).array().abs() > half.array() + cube * turn.colwise().sum().transpose().array())
          .any())
    return false;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double apart = std::abs(between[i2] * rotation(i1, j) - between[i1] * rotation(i2, j));
      if (apart > cube * (turn(i1, j) + turn(i2, j)) + half[j1] * turn(i, j2) + half[j2] * turn(i, j1)) return false;
    }
  }
  return true;
}

}  // namespace sculpt
