// Convex shapes, meshes and poses at random, and distances by a slow way that shares nothing with the fast one.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "core/base/random.hpp"
#include "core/collision/shape/convex.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

inline Vec3 random_vector(Random& random, double size) {
  return {random.between(-size, size), random.between(-size, size), random.between(-size, size)};
}

inline Vec3 random_direction(Random& random) {
  for (;;)
    if (const Vec3 v = random_vector(random, 1); v.norm() > 0.1 && v.norm() <= 1) return v.normalized();
}

inline Frame random_pose(Random& random, double size = 0.5) {
  Frame pose = Frame::Identity();
  pose.linear() =
      Eigen::AngleAxisd(random.between(0, 2 * std::numbers::pi), random_direction(random)).toRotationMatrix();
  pose.translation() = random_vector(random, size);
  return pose;
}

inline Convex random_convex(Random& random) {
  const Frame pose = random_pose(random);
  const auto size = [&] { return random.between(0.02, 0.3); };
  switch (static_cast<int>(random.between(0, 5))) {
    case 0:
      return Convex::sphere(pose.translation(), size());
    case 1:
      return Convex::capsule(pose.translation(), pose * Vec3(0, 0, size()), size() / 4);
    case 2:
      return Convex::box(pose, {size(), size(), size()});
    case 3:
      return Convex::cylinder(pose, size(), size());
    default:
      return Convex::triangle(pose.translation(), pose * random_vector(random, 0.3), pose * random_vector(random, 0.3));
  }
}

inline Vec3 random_point_of(const Convex& shape, Random& random) {
  const Vec3 rounding = shape.radius * random.unit() * random_direction(random);
  if (shape.kind == Convex::Kind::triangle) {
    double a = random.unit(), b = random.unit();
    if (a + b > 1) a = 1 - a, b = 1 - b;
    return shape.middle + a * shape.axes.col(0) + b * shape.axes.col(1) + rounding;
  }
  Vec3 local = random_vector(random, 1).cwiseProduct(shape.half);
  if (shape.kind == Convex::Kind::cylinder) {
    const double angle = random.between(0, 2 * std::numbers::pi), away = std::sqrt(random.unit()) * shape.half.x();
    local.head<2>() << away * std::cos(angle), away * std::sin(angle);
  }
  return shape.middle + shape.axes * local + rounding;
}

/// The farthest point of the shape along a direction, less its radius.
inline Vec3 farthest_point(const Convex& shape, const Vec3& along) {
  const Vec3 local = shape.axes.transpose() * along;
  if (shape.kind == Convex::Kind::triangle) {
    if (local.x() <= 0 && local.y() <= 0) return shape.middle;
    return shape.middle + shape.axes.col(local.x() > local.y() ? 0 : 1);
  }
  Vec3 at(std::copysign(shape.half.x(), local.x()), std::copysign(shape.half.y(), local.y()),
          std::copysign(shape.half.z(), local.z()));
  if (shape.kind == Convex::Kind::cylinder) {
    const double length = local.head<2>().norm();
    at.head<2>() = length > 0 ? Eigen::Vector2d(local.head<2>() * (shape.half.x() / length)) : Eigen::Vector2d::Zero();
  }
  return shape.middle + shape.axes * at;
}

/// Not less than the distance of the two, and little more, by conditional gradients (Frank, Wolfe, 1956).
inline double slow_distance(const Convex& first, const Convex& second) {
  Vec3 between = first.centre() - second.centre();
  for (int step = 0; step < 4000; ++step) {
    const Vec3 vertex = farthest_point(first, -between) - farthest_point(second, between);
    const Vec3 way = vertex - between;
    const double square = way.squaredNorm();
    if (square < 1e-24) break;
    const double share = std::clamp(-between.dot(way) / square, 0.0, 1.0);
    if (share <= 0) break;
    between += share * way;
  }
  return std::max(0.0, between.norm() - first.radius - second.radius);
}

/// Triangles strewn along z.
inline std::shared_ptr<Mesh> random_mesh(Random& random, int triangles) {
  auto mesh = std::make_shared<Mesh>();
  for (int t = 0; t < triangles; ++t) {
    const Vec3 at(random.between(-0.1, 0.1), random.between(-0.1, 0.1), random.between(0, 0.5));
    for (int v = 0; v < 3; ++v) mesh->vertices.push_back(at + random_vector(random, 0.02));
    const auto first = static_cast<std::uint32_t>(3 * t);
    mesh->triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace sculpt
