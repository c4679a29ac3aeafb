#include "core/verify/mill/moving_cutter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sculpt {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// A rim, as a stack of discs, each from as low as the next larger one: a little more than the rim.
constexpr int discs = 8;

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

MovingCutter::MovingCutter(const Cutter& cutter, const Vec3& axis, const Vec3& from, const Vec3& to)
    : is_ball_(cutter.kind == CutterKind::ball),
      radius_(1000 * cutter.radius_m),
      corner_(1000 * cutter.corner_radius_m),
      flute_(1000 * cutter.flute_m),
      axis_(axis),
      from_(from),
      to_(to),
      base_from_(from + corner_ * axis),
      base_to_(to + corner_ * axis),
      level_(to - from - (to - from).dot(axis) * axis),
      lowest_base_(std::min(base_from_.dot(axis), base_to_.dot(axis))),
      top_(std::max(from.dot(axis), to.dot(axis)) + flute_) {}

Eigen::AlignedBox3d MovingCutter::box(double more_mm) const {
  Eigen::AlignedBox3d box;
  const Vec3 up = flute_ * axis_, room = Vec3::Constant(radius_ + more_mm);
  for (const Vec3& end : {from_, to_})
    for (const Vec3& place : {end, Vec3(end + up)}) box.extend(place - room).extend(place + room);
  return box;
}

bool MovingCutter::is_near(const Vec3& middle, double radius, double more_mm) const {
  const double reach = radius_ + more_mm + radius, height = middle.dot(axis_);
  if (height + radius < lowest_base_ - radius_ - more_mm) return false;
  // Seen along the axis, beside the way; and below a ball.
  const Vec3 off = middle - from_, beside = off - off.dot(axis_) * axis_;
  const double level2 = level_.squaredNorm();
  const double share = level2 > 0 ? std::clamp(beside.dot(level_) / level2, 0.0, 1.0) : 0;
  const double beside2 = (beside - share * level_).squaredNorm(),
               under = is_ball_ ? std::max(0.0, lowest_base_ - height) : 0;
  return beside2 + under * under <= reach * reach;
}

double MovingCutter::depth(const std::array<Vec3, 3>& t) const {
  if (is_ball_)
    return radius_ - std::min(to_triangle(base_from_, base_to_, t), across_rod(axis_, base_from_, base_to_, t, top_));
  // What is higher than the base somewhere on the way; of others than balls, than the tip.
  const double deepest = radius_ - across(axis_, base_from_, base_to_, t, lowest_base_, top_);
  const double tip = std::min(from_.dot(axis_), to_.dot(axis_));
  if (corner_ <= 0) return std::max(deepest, radius_ - across(axis_, from_, to_, t, tip, top_));
  double rim_depth = deepest;
  for (int disc = 0; disc < discs; ++disc) {
    const double part = static_cast<double>(disc + 1) / discs, radius = radius_ - corner_ + corner_ * part;
    const double rim = corner_ * (1 - std::sqrt(std::max(0.0, 1 - std::pow(part - 1.0 / discs, 2))));
    rim_depth = std::max(rim_depth, radius - across(axis_, from_, to_, t, tip + rim, top_));
  }
  return rim_depth;
}

}  // namespace sculpt
