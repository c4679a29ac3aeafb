#include "core/collision/shape/convex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sculpt {
namespace {

using Kind = Convex::Kind;

constexpr int max_projections = 24, few_projections = 3;
constexpr int prism_sides = 12;
constexpr double max_ratio = 0.99;
constexpr double nearly = 0.98;  // of the distance: a plane that good needs no better one

/// The point of the triangle nearest to `point` (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 project_on_triangle(const Convex& shape, const Vec3& point) {
  const Vec3 ab = shape.axes.col(0), ac = shape.axes.col(1), ap = point - shape.middle;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return shape.middle;
  const Vec3 bp = ap - ab;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return shape.middle + ab;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return shape.middle + ab * (d1 / (d1 - d3));
  const Vec3 cp = ap - ac;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return shape.middle + ac;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return shape.middle + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return shape.middle + ab + (ac - ab) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return sum > 0 ? Vec3(shape.middle + ab * (vb / sum) + ac * (vc / sum)) : shape.middle;
}

/// The point of the shape, less its radius, nearest to `point`.
Vec3 project(const Convex& shape, const Vec3& point) {
  if (shape.kind == Kind::triangle) return project_on_triangle(shape, point);
  Vec3 local = shape.axes.transpose() * (point - shape.middle);
  if (shape.kind == Kind::box) {
    local = local.cwiseMax(-shape.half).cwiseMin(shape.half);
  } else {
    local.z() = std::clamp(local.z(), -shape.half.z(), shape.half.z());
    if (const double away = local.head<2>().norm(); away > shape.half.x()) local.head<2>() *= shape.half.x() / away;
  }
  return shape.middle + shape.axes * local;
}

struct Interval {
  double low, high;
};

/// What the shape, less its radius, covers along a direction of length 1.
Interval cover(const Convex& shape, const Vec3& along) {
  const double middle = along.dot(shape.middle);
  const Vec3 by_axis = shape.axes.transpose() * along;
  double half = 0;
  switch (shape.kind) {
    case Kind::triangle: {
      const auto [low, high] = std::minmax({0.0, by_axis.x(), by_axis.y()});
      return {middle + low, middle + high};
    }
    case Kind::box:
      half = by_axis.cwiseAbs().dot(shape.half);
      break;
    case Kind::cylinder:
      half = std::abs(by_axis.z()) * shape.half.z() + by_axis.head<2>().norm() * shape.half.x();
  }
  return {middle - half, middle + half};
}

/// Keeps the best plane of those it is asked to try.
class PlaneSearch {
 public:
  PlaneSearch(const Convex& first, const Convex& second, double enough)
      : first_(first), second_(second), enough_(enough) {
    best_.gap = std::numeric_limits<double>::lowest();
  }

  const Separation& best() const { return best_; }
  bool is_enough() const { return best_.gap >= enough_; }

  void look_across(const Vec3& way) {
    const double length = way.norm();
    if (!(length > shortest)) return;
    const Vec3 normal = way / length;
    const Interval one = cover(first_, normal), other = cover(second_, normal);
    const double rounding = first_.radius + second_.radius;
    if (const double gap = one.low - other.high - rounding; gap > best_.gap)
      best_ = {normal, gap, other.high + second_.radius};
    if (const double gap = other.low - one.high - rounding; gap > best_.gap)
      best_ = {-normal, gap, second_.radius - other.low};
  }

 private:
  static constexpr double shortest = 1e-12;

  const Convex &first_, &second_;
  double enough_;
  Separation best_;
};

/// Directions of faces, and of edges: those of a box or a cylinder are its axes.
std::size_t face_count(const Convex& shape) {
  return shape.kind == Kind::triangle ? 1 : 3;
}
Vec3 face(const Convex& shape, std::size_t which) {
  return shape.axes.col(shape.kind == Kind::triangle ? 2 : static_cast<Eigen::Index>(which));
}
Vec3 edge(const Convex& shape, std::size_t which) {
  if (shape.kind == Kind::triangle && which == 2) return shape.axes.col(1) - shape.axes.col(0);
  return shape.axes.col(static_cast<Eigen::Index>(which));
}

/// Where steps that shrink like those from the first point to the second and on to the third lead to.
Vec3 extrapolate(const Vec3& first, const Vec3& second, const Vec3& third) {
  const double before = (second - first).norm(), last = (third - second).norm();
  if (!(last < before)) return third;
  const double ratio = std::min(last / before, max_ratio);
  return third + ratio / (1 - ratio) * (third - second);
}

}  // namespace

Convex Convex::sphere(const Vec3& middle, double radius) {
  Convex shape;
  shape.middle = middle;
  shape.radius = radius;
  return shape;
}

Convex Convex::capsule(const Vec3& a, const Vec3& b, double radius) {
  Convex shape = sphere((a + b) / 2, radius);
  shape.axes = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), b - a).toRotationMatrix();
  shape.half.z() = (b - a).norm() / 2;
  return shape;
}

Convex Convex::box(const Frame& pose, const Vec3& half) {
  Convex shape;
  shape.middle = pose.translation();
  shape.axes = pose.linear();
  shape.half = half;
  return shape;
}

Convex Convex::cylinder(const Frame& pose, double radius, double half_length) {
  Convex shape = box(pose, {radius, radius, half_length});
  shape.kind = Kind::cylinder;
  return shape;
}

Convex Convex::triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  Convex shape;
  shape.kind = Kind::triangle;
  shape.middle = a;
  const Vec3 normal = (b - a).cross(c - a);
  shape.axes << b - a, c - a, normal.stableNormalized();
  return shape;
}

Convex Convex::placed(const Frame& pose) const {
  Convex shape = *this;
  shape.middle = pose * middle;
  shape.axes = pose.linear().lazyProduct(axes);
  return shape;
}

Convex::Corners Convex::corners() const {
  Corners corners;
  corners.radius = radius;
  switch (kind) {
    case Kind::triangle:
      corners.add(middle);
      corners.add(middle + axes.col(0));
      corners.add(middle + axes.col(1));
      break;
    case Kind::box:
      for (int corner = 0; corner < 8; ++corner) {
        const auto is_twin = [&](int axis) { return (corner >> axis & 1) == 1 && half[axis] == 0; };
        if (is_twin(0) || is_twin(1) || is_twin(2)) continue;
        const Vec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        corners.add(middle + axes * half.cwiseProduct(sign));
      }
      break;
    case Kind::cylinder:
      // Of a prism around it.
      const double around = half.x() / std::cos(std::numbers::pi / prism_sides);
      for (int side = 0; side < prism_sides; ++side) {
        const double angle = 2 * std::numbers::pi * side / prism_sides;
        const Vec3 at = middle + axes * Vec3(around * std::cos(angle), around * std::sin(angle), 0);
        corners.add(at + axes.col(2) * half.z());
        corners.add(at - axes.col(2) * half.z());
      }
  }
  return corners;
}

Separation separate(const Convex& first, const Convex& second, double enough, Effort effort) {
  PlaneSearch search(first, second, enough);
  const double rounding = first.radius + second.radius;
  std::array<Vec3, 3> on_first;
  on_first.fill(first.centre());
  search.look_across(on_first[2] - second.centre());
  const int projections = effort == Effort::full ? max_projections : few_projections;
  for (int projection = 1; projection <= projections && !search.is_enough(); ++projection) {
    const Vec3 on_second = project(second, on_first[2]);
    on_first = {on_first[1], on_first[2], project(first, on_second)};
    const double apart = (on_first[2] - on_second).norm();
    if (apart == 0) break;
    search.look_across(on_first[2] - on_second);
    if (search.best().gap >= nearly * apart - rounding) return search.best();
    if (projection % 3 == 0) on_first[2] = project(first, extrapolate(on_first[0], on_first[1], on_first[2]));
  }
  if (effort == Effort::rough) return search.best();
  for (std::size_t of = 0; of < face_count(first) && !search.is_enough(); ++of) search.look_across(face(first, of));
  for (std::size_t of = 0; of < face_count(second) && !search.is_enough(); ++of) search.look_across(face(second, of));
  for (std::size_t one = 0; one < 3 && !search.is_enough(); ++one)
    for (std::size_t other = 0; other < 3; ++other) search.look_across(edge(first, one).cross(edge(second, other)));
  return search.best();
}

}  // namespace sculpt
