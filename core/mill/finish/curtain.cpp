#include "core/mill/finish/curtain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mill/finish/seen_from_above.hpp"

namespace sculpt {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double segment_distance2(const Vec3& p, const Vec3& d, const Vec3& q, const Vec3& e) {
  const Vec3 r = p - q;
  const double a = d.squaredNorm(), b = e.squaredNorm(), c = d.dot(r), f = e.dot(r), g = d.dot(e);
  double s = 0;
  if (a > 0) {
    const double denominator = a * b - g * g;
    s = denominator > 1e-15 * a * b ? std::clamp((g * f - c * b) / denominator, 0.0, 1.0) : 0;
  }
  const double t = b > 0 ? std::clamp((g * s + f) / b, 0.0, 1.0) : 0;
  if (a > 0) s = std::clamp((g * t - c) / a, 0.0, 1.0);
  return (r + s * d - t * e).squaredNorm();
}

/// Between two points in plan.
double plan_distance2(const Vec3& a, const Vec3& b) {
  return (a - b).head<2>().squaredNorm();
}

/// From the upright ray that begins at `from` to an edge, where the edge is higher than that.
double ray_distance2(const Vec3& from, const Vec3& a, const Vec3& b) {
  const double du = b.x() - a.x(), dv = b.y() - a.y(), length2 = du * du + dv * dv;
  const double t =
      length2 > 0 ? std::clamp(((from.x() - a.x()) * du + (from.y() - a.y()) * dv) / length2, 0.0, 1.0) : 1;
  const Vec3 at = a + t * (b - a);
  return at.z() >= from.z() ? plan_distance2(at, from) : infinity;
}

/// From an end, straight onto the inside of the triangle; or the triangle is above the end.
bool is_near_inside(const Vec3& end, const std::array<Vec3, 3>& t, const Vec3& normal, double distance2) {
  const double off = normal.dot(end - t[0]);
  if (off * off < distance2) {
    const Vec3 foot = end - off * normal;
    bool inside = true;
    for (std::size_t at = 0; at < 3 && inside; ++at)
      inside = (t[(at + 1) % 3] - t[at]).cross(foot - t[at]).dot((t[1] - t[0]).cross(t[2] - t[0])) >= 0;
    if (inside) return true;
  }
  return normal.z() > upright && off <= 0 && covers(t, end.x(), end.y());
}

}  // namespace

Curtain::Curtain(const Vec3& from, const Vec3& to)
    : from_(from), way_(to - from), plan2_(way_.head<2>().squaredNorm()) {
  if (plan2_ >= 1e-20) return;
  if (way_.z() < 0) from_ = to;  // upright: the ray from its lower end
  way_.setZero();
  plan2_ = 0;
}

bool Curtain::is_nearer(const std::array<Vec3, 3>& t, const Vec3& normal, double distance2) const {
  const Vec3 to = from_ + way_;
  for (std::size_t at = 0; at < 3; ++at) {
    const Vec3 &a = t[at], &b = t[(at + 1) % 3];
    if (segment_distance2(from_, way_, a, b - a) < distance2) return true;
    if (ray_distance2(from_, a, b) < distance2 || above_distance2(a) < distance2) return true;
    if (plan2_ > 0 && (ray_distance2(to, a, b) < distance2 || crosses(a, b))) return true;
  }
  return is_near_inside(from_, t, normal, distance2) || (plan2_ > 0 && is_near_inside(to, t, normal, distance2));
}

/// Straight across, of a point that is above the way.
double Curtain::above_distance2(const Vec3& point) const {
  if (plan2_ == 0) return infinity;
  const double du = point.x() - from_.x(), dv = point.y() - from_.y();
  const double along = du * way_.x() + dv * way_.y();
  if (along < 0 || along > plan2_ || (point.z() - from_.z()) * plan2_ < along * way_.z()) return infinity;
  const double side = du * way_.y() - dv * way_.x();
  return side * side / plan2_;
}

bool Curtain::crosses(const Vec3& a, const Vec3& b) const {
  const auto side = [&](const Vec3& p) { return (p.x() - from_.x()) * way_.y() - (p.y() - from_.y()) * way_.x(); };
  const double first = side(a), second = side(b);
  if ((first > 0) == (second > 0)) return false;
  return above_distance2(a + (b - a) * (first / (first - second))) < infinity;
}

}  // namespace sculpt
