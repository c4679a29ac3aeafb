#include "core/verify/mill/surface_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

constexpr int boxes_along = 96;
constexpr double infinity = std::numeric_limits<double>::infinity();
/// A way that climbs more is looked at in parts.
constexpr double most_rise_mm = 0.25;

double between_segments(const Vec3& p, const Vec3& d, const Vec3& q, const Vec3& e) {
  const Vec3 r = p - q;
  const double a = d.squaredNorm(), b = e.squaredNorm(), f = e.dot(r);
  double s = 0, t = 0;
  if (a < 1e-24 && b < 1e-24) return r.norm();
  if (a < 1e-24) {
    t = std::clamp(f / b, 0.0, 1.0);
  } else {
    const double c = d.dot(r);
    if (b < 1e-24) {
      s = std::clamp(-c / a, 0.0, 1.0);
    } else {
      const double g = d.dot(e), denominator = a * b - g * g;
      s = denominator > 1e-18 * a * b ? std::clamp((g * f - c * b) / denominator, 0.0, 1.0) : 0;
      t = (g * s + f) / b;
      if (t < 0 || t > 1) {
        t = std::clamp(t, 0.0, 1.0);
        s = std::clamp((g * t - c) / a, 0.0, 1.0);
      }
    }
  }
  return (r + s * d - t * e).norm();
}

/// From a point to the inside of a triangle, straight across; infinite where it is not above the inside.
double above_inside(const Vec3& point, const std::array<Vec3, 3>& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = normal.norm();
  if (area < 1e-18) return infinity;
  for (std::size_t at = 0; at < 3; ++at)
    if ((t[(at + 1) % 3] - t[at]).cross(point - t[at]).dot(normal) < 0) return infinity;
  return std::abs((point - t[0]).dot(normal)) / area;
}

bool pierces(const Vec3& from, const Vec3& to, const std::array<Vec3, 3>& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double a = (from - t[0]).dot(normal), b = (to - t[0]).dot(normal);
  if ((a > 0) == (b > 0) || a == b) return false;
  const Vec3 at = from + (to - from) * (a / (a - b));
  for (std::size_t edge = 0; edge < 3; ++edge)
    if ((t[(edge + 1) % 3] - t[edge]).cross(at - t[edge]).dot(normal) < 0) return false;
  return true;
}

double to_triangle(const Vec3& from, const Vec3& to, const std::array<Vec3, 3>& t) {
  double least = std::min(above_inside(from, t), above_inside(to, t));
  for (std::size_t at = 0; at < 3; ++at)
    least = std::min(least, between_segments(from, to - from, t[at], t[(at + 1) % 3] - t[at]));
  return pierces(from, to, t) ? 0 : least;
}

/// Across the axis, from the way of the axis to that part of the triangle that is higher than `bottom` and not higher
/// than `top`.
double across(const Vec3& axis, const Vec3& from, const Vec3& to, const std::array<Vec3, 3>& t, double bottom,
              double top) {
  std::vector<Vec3> part(t.begin(), t.end());
  for (const auto& [sign, bound] : {std::pair{1.0, bottom}, {-1.0, -top}}) {
    std::vector<Vec3> kept;
    for (std::size_t at = 0; at < part.size(); ++at) {
      const Vec3 &a = part[at], &b = part[(at + 1) % part.size()];
      const double in_a = sign * a.dot(axis) - bound, in_b = sign * b.dot(axis) - bound;
      if (in_a >= 0) kept.push_back(a);
      if ((in_a > 0 && in_b < 0) || (in_a < 0 && in_b > 0)) kept.push_back(a + (b - a) * (in_a / (in_a - in_b)));
    }
    part = std::move(kept);
    if (part.empty()) return infinity;
  }
  const auto flat = [&](const Vec3& p) { return Vec3(p - p.dot(axis) * axis); };
  double least = infinity;
  const Vec3 a = flat(from), b = flat(to);
  for (std::size_t at = 0; at < part.size(); ++at) {
    const Vec3 p = flat(part[at]), q = flat(part[(at + 1) % part.size()]);
    least = std::min(least, between_segments(a, b - a, p, q - p));
  }
  // Or the axis goes through it.
  for (std::size_t at = 1; at + 1 < part.size(); ++at) {
    const std::array<Vec3, 3> fan{flat(part[0]), flat(part[at]), flat(part[at + 1])};
    const auto turn = [&](const Vec3& p, const Vec3& q) { return axis.dot((q - p).cross(a - p)); };
    const double x = turn(fan[0], fan[1]), y = turn(fan[1], fan[2]), z = turn(fan[2], fan[0]);
    if ((x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0)) return 0;
  }
  return least;
}

}  // namespace

SurfaceGrid::SurfaceGrid(const Mesh& part) {
  Eigen::AlignedBox3d all;
  for (const auto& t : part.triangles) {
    triangles_.push_back({1000 * part.vertices[t[0]], 1000 * part.vertices[t[1]], 1000 * part.vertices[t[2]]});
    for (const Vec3& corner : triangles_.back()) all.extend(corner);
  }
  if (triangles_.empty()) return;
  low_ = all.min();
  edge_ = std::max(1e-6, all.sizes().maxCoeff() / boxes_along);
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    boxes_[axis] = static_cast<int>(all.sizes()[static_cast<int>(axis)] / edge_) + 1;
    count *= static_cast<std::size_t>(boxes_[axis]);
  }
  begin_.assign(count + 1, 0);
  const auto for_each_box = [&](const Corners& t, const auto& visit) {
    const auto first = box_of(t[0].cwiseMin(t[1]).cwiseMin(t[2])), last = box_of(t[0].cwiseMax(t[1]).cwiseMax(t[2]));
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i)
          visit(static_cast<std::size_t>(i) +
                static_cast<std::size_t>(boxes_[0]) *
                    (static_cast<std::size_t>(j) + static_cast<std::size_t>(boxes_[1]) * static_cast<std::size_t>(k)));
  };
  for (const Corners& t : triangles_) for_each_box(t, [&](std::size_t box) { ++begin_[box + 1]; });
  for (std::size_t box = 0; box < count; ++box) begin_[box + 1] += begin_[box];
  numbers_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t number = 0; number < triangles_.size(); ++number)
    for_each_box(triangles_[number], [&](std::size_t box) { numbers_[next[box]++] = number; });
  seen_.resize(triangles_.size());
}

std::array<int, 3> SurfaceGrid::box_of(const Vec3& point) const {
  std::array<int, 3> box{};
  for (int axis = 0; axis < 3; ++axis) {
    const double at = (point[axis] - low_[axis]) / edge_;
    box[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::clamp(std::floor(at), 0.0, boxes_[static_cast<std::size_t>(axis)] - 1.0));
  }
  return box;
}

const std::vector<std::uint32_t>& SurfaceGrid::within(const Vec3& low, const Vec3& high) {
  found_.clear();
  ++search_;
  const auto first = box_of(low), last = box_of(high);
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        const std::size_t box =
            static_cast<std::size_t>(i) +
            static_cast<std::size_t>(boxes_[0]) *
                (static_cast<std::size_t>(j) + static_cast<std::size_t>(boxes_[1]) * static_cast<std::size_t>(k));
        for (std::uint32_t at = begin_[box]; at < begin_[box + 1]; ++at) {
          const std::uint32_t number = numbers_[at];
          if (seen_[number] == search_) continue;
          seen_[number] = search_;
          const Corners& t = triangles_[number];
          if ((t[0].cwiseMax(t[1]).cwiseMax(t[2]).array() < low.array()).any() ||
              (t[0].cwiseMin(t[1]).cwiseMin(t[2]).array() > high.array()).any())
            continue;
          found_.push_back(number);
        }
      }
  return found_;
}

double SurfaceGrid::depth(const Cutter& cutter, const Vec3& axis, const Vec3& from, const Vec3& to, double enough_mm) {
  if (triangles_.empty()) return -enough_mm;
  const double radius = 1000 * cutter.radius_m, corner = 1000 * cutter.corner_radius_m, flute = 1000 * cutter.flute_m;
  const double rise = std::abs((to - from).dot(axis));
  const int parts = std::max(1, static_cast<int>(std::ceil(rise / most_rise_mm)));
  double deepest = -enough_mm;
  for (int part = 0; part < parts; ++part) {
    const Vec3 a = from + (to - from) * part / parts, b = from + (to - from) * (part + 1) / parts;
    const Vec3 up = flute * axis, room = Vec3::Constant(radius + enough_mm);
    const Vec3 low = a.cwiseMin(b).cwiseMin(a + up).cwiseMin(b + up) - room,
               high = a.cwiseMax(b).cwiseMax(a + up).cwiseMax(b + up) + room;
    const Vec3 base_a = a + corner * axis, base_b = b + corner * axis;
    for (const std::uint32_t number : within(low, high)) {
      const Corners& t = triangles_[number];
      if (cutter.kind == CutterKind::ball) deepest = std::max(deepest, radius - to_triangle(base_a, base_b, t));
      // What is higher than the base somewhere on the way; of others than balls, than the tip.
      const double bottom = std::min(base_a.dot(axis), base_b.dot(axis)),
                   top = std::max(a.dot(axis), b.dot(axis)) + flute;
      deepest = std::max(deepest, radius - across(axis, base_a, base_b, t, bottom, top));
      if (cutter.kind == CutterKind::ball) continue;
      // A rim, as a stack of discs, each from as low as the next larger one: a little more than the rim.
      const double tip = std::min(a.dot(axis), b.dot(axis));
      constexpr int discs = 8;
      for (int disc = 0; disc < discs; ++disc) {
        const double share = static_cast<double>(disc + 1) / discs, r = radius - corner + corner * share;
        const double lowest =
            corner > 0 ? corner * (1 - std::sqrt(std::max(0.0, 1 - std::pow(share - 1.0 / discs, 2)))) : 0;
        deepest = std::max(deepest, (corner > 0 ? r : radius) - across(axis, a, b, t, tip + lowest, top));
        if (corner <= 0) break;
      }
    }
  }
  return deepest;
}

}  // namespace sculpt
