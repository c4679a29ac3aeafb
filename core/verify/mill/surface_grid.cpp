#include "core/verify/mill/surface_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

constexpr int boxes_along = 96;
constexpr double infinity = std::numeric_limits<double>::infinity();
/// A way that climbs more is looked at in parts.
constexpr double max_rise_mm = 0.25;

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

/// A convex piece of a triangle.
struct Piece {
  std::array<Vec3, 8> corners;
  std::size_t count = 0;
};

/// What of it is above a plane.
Piece above(const Piece& piece, const Vec3& normal, double offset) {
  Piece kept;
  for (std::size_t at = 0; at < piece.count; ++at) {
    const Vec3 &a = piece.corners[at], &b = piece.corners[(at + 1) % piece.count];
    const double in_a = a.dot(normal) - offset, in_b = b.dot(normal) - offset;
    if (in_a >= 0) kept.corners[kept.count++] = a;
    if ((in_a > 0 && in_b < 0) || (in_a < 0 && in_b > 0))
      kept.corners[kept.count++] = a + (b - a) * (in_a / (in_a - in_b));
  }
  return kept;
}

/// Across the axis, from the way of the axis to a piece.
double across(const Vec3& axis, const Vec3& from, const Vec3& to, const Piece& piece) {
  const auto flat = [&](const Vec3& p) { return Vec3(p - p.dot(axis) * axis); };
  double least = infinity;
  const Vec3 a = flat(from), b = flat(to);
  Piece plan = piece;
  for (std::size_t at = 0; at < plan.count; ++at) plan.corners[at] = flat(piece.corners[at]);
  for (std::size_t at = 0; at < plan.count; ++at) {
    const Vec3 &p = plan.corners[at], &q = plan.corners[(at + 1) % plan.count];
    least = std::min(least, between_segments(a, b - a, p, q - p));
  }
  // Or the axis goes through it.
  for (std::size_t at = 1; at + 1 < plan.count; ++at) {
    const std::array<Vec3, 3> fan{plan.corners[0], plan.corners[at], plan.corners[at + 1]};
    const auto turn = [&](const Vec3& p, const Vec3& q) { return axis.dot((q - p).cross(a - p)); };
    const double x = turn(fan[0], fan[1]), y = turn(fan[1], fan[2]), z = turn(fan[2], fan[0]);
    if ((x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0)) return 0;
  }
  return least;
}

/// The same, to that part of a triangle that is higher than `bottom` and not higher than `top`.
double across(const Vec3& axis, const Vec3& from, const Vec3& to, const std::array<Vec3, 3>& t, double bottom,
              double top) {
  const Piece whole{{t[0], t[1], t[2]}, 3};
  return across(axis, from, to, above(above(whole, axis, bottom), -axis, -top));
}

/// The same for the rod above a ball that goes straight from one place to another: what is above the way itself, and
/// above its upper end.
double across_rod(const Vec3& axis, const Vec3& from, const Vec3& to, const std::array<Vec3, 3>& t, double top) {
  const Vec3 way = to - from, level = way - way.dot(axis) * axis;
  const double length = level.norm();
  const Vec3& upper = way.dot(axis) > 0 ? to : from;
  const double lowest = std::min(from.dot(axis), to.dot(axis));
  const Piece whole{{t[0], t[1], t[2]}, 3};
  const Piece high = above(above(whole, axis, lowest), -axis, -top);
  if (high.count == 0) return infinity;
  double least = across(axis, upper, upper, above(high, axis, upper.dot(axis)));
  if (length > 1e-12) {
    // The plane through the way that is level across it.
    const Vec3 normal = axis - level * (way.dot(axis) / (length * length));
    least = std::min(least, across(axis, from, to, above(high, normal, from.dot(normal))));
  }
  return least;
}

}  // namespace

SurfaceGrid::SurfaceGrid(const Mesh& part) {
  Eigen::AlignedBox3d all;
  for (const auto& t : part.triangles) {
    triangles_.push_back({1000 * part.vertices[t[0]], 1000 * part.vertices[t[1]], 1000 * part.vertices[t[2]]});
    const Corners& corners = triangles_.back();
    for (const Vec3& corner : corners) all.extend(corner);
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    double radius = 0;
    for (const Vec3& corner : corners) radius = std::max(radius, (corner - middle).norm());
    balls_.push_back({middle, radius * (1 + 1e-9)});
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
  const bool is_ball = cutter.kind == CutterKind::ball;
  const double rise = std::abs((to - from).dot(axis));
  const int parts = is_ball ? 1 : std::max(1, static_cast<int>(std::ceil(rise / max_rise_mm)));
  double deepest = -enough_mm;
  for (int part = 0; part < parts; ++part) {
    const Vec3 a = from + (to - from) * part / parts, b = from + (to - from) * (part + 1) / parts;
    const Vec3 up = flute * axis, room = Vec3::Constant(radius + enough_mm);
    const Vec3 low = a.cwiseMin(b).cwiseMin(a + up).cwiseMin(b + up) - room,
               high = a.cwiseMax(b).cwiseMax(a + up).cwiseMax(b + up) + room;
    const Vec3 base_a = a + corner * axis, base_b = b + corner * axis;
    const double reach = radius - deepest, top = std::max(a.dot(axis), b.dot(axis)) + flute,
                 lowest = std::min(base_a.dot(axis), base_b.dot(axis)) - reach;
    const Vec3 level = (b - a) - (b - a).dot(axis) * axis;
    const double level2 = level.squaredNorm();
    for (const std::uint32_t number : within(low, high)) {
      const Corners& t = triangles_[number];
      if (std::max({t[0].dot(axis), t[1].dot(axis), t[2].dot(axis)}) < lowest) continue;
      const Ball& ball = balls_[number];
      const double near = reach + ball.radius;
      // Seen along the axis it is beside the way.
      const Vec3 off = ball.middle - a, beside = off - off.dot(axis) * axis;
      const double share = level2 > 0 ? std::clamp(beside.dot(level) / level2, 0.0, 1.0) : 0;
      if ((beside - share * level).squaredNorm() > near * near) continue;
      if (is_ball) {
        deepest = std::max(deepest, radius - to_triangle(base_a, base_b, t));
        deepest = std::max(deepest, radius - across_rod(axis, base_a, base_b, t, top));
        continue;
      }
      // What is higher than the base somewhere on the way; of others than balls, than the tip.
      const double bottom = std::min(base_a.dot(axis), base_b.dot(axis));
      deepest = std::max(deepest, radius - across(axis, base_a, base_b, t, bottom, top));
      // A rim, as a stack of discs, each from as low as the next larger one: a little more than the rim.
      const double tip = std::min(a.dot(axis), b.dot(axis));
      constexpr int discs = 8;
      for (int disc = 0; disc < discs; ++disc) {
        const double part_of = static_cast<double>(disc + 1) / discs, r = radius - corner + corner * part_of;
        const double rim =
            corner > 0 ? corner * (1 - std::sqrt(std::max(0.0, 1 - std::pow(part_of - 1.0 / discs, 2)))) : 0;
        deepest = std::max(deepest, (corner > 0 ? r : radius) - across(axis, a, b, t, tip + rim, top));
        if (corner <= 0) break;
      }
    }
  }
  return deepest;
}

}  // namespace sculpt
