#include "core/mill/finish/facet_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mill/map/float_bound.hpp"

namespace sculpt {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Cells: about so many facets each, and at most so many along a side.
constexpr double facets_a_cell = 4, max_along = 1024;
constexpr double upright = 1e-9;
/// More than coordinates of a stock are rounded by.
constexpr double rounding_m = 1e-9;

double turn(const Vec3& a, const Vec3& b, double u, double v) {
  return (b.x() - a.x()) * (v - a.y()) - (b.y() - a.y()) * (u - a.x());
}

/// In plan: is (u, v) inside of the triangle?
bool covers(const std::array<Vec3, 3>& t, double u, double v) {
  const double x = turn(t[0], t[1], u, v), y = turn(t[1], t[2], u, v), z = turn(t[2], t[0], u, v);
  return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
}

/// Height of a ball's middle over (u, v) that rests on a point; `height` where that is higher.
double over_corner(const Vec3& corner, double u, double v, double r2, double height) {
  const double left = r2 - (u - corner.x()) * (u - corner.x()) - (v - corner.y()) * (v - corner.y());
  const double above = height - corner.z();
  return left < 0 || (above > 0 && above * above >= left) ? height : std::max(height, corner.z() + std::sqrt(left));
}

/// The same on an edge, between its ends.
double over_edge(const Vec3& a, const Vec3& b, double u, double v, double r2, double height) {
  const Vec3 way = b - a;
  const double length2 = way.squaredNorm();
  const double mu = u - a.x(), mv = v - a.y(), along = mu * way.x() + mv * way.y();
  // Distance from the edge's line of (mu, mv, z): length2 (mu^2 + mv^2 + z^2) - (along + z way.z)^2 = length2 r2.
  const double c2 = length2 - way.z() * way.z(), c1 = along * way.z(),
               c0 = length2 * (mu * mu + mv * mv - r2) - along * along;
  if (c2 <= upright * length2) return height;
  const double above = height - a.z();
  if (c2 * above > c1 && (c2 * above - 2 * c1) * above + c0 >= 0) return height;  // above both roots
  const double root = c1 * c1 - c2 * c0;
  if (root < 0) return height;
  const double z = (c1 + std::sqrt(root)) / c2, share = along + z * way.z();
  return share < 0 || share > length2 ? height : std::max(height, a.z() + z);
}

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

/// How far a value is outside of a range.
double outside(double value, double low, double high) {
  return std::max({0.0, low - value, value - high});
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

/// What is above a straight way: all points (from + t way) + (0, 0, s), s >= 0.
class Curtain {
 public:
  Curtain(const Vec3& from, const Vec3& to) : from_(from), way_(to - from), plan2_(way_.head<2>().squaredNorm()) {
    if (plan2_ < 1e-20) {  // upright: the ray from its lower end
      if (way_.z() < 0) from_ = to;
      way_.setZero();
      plan2_ = 0;
    }
  }

  bool is_nearer(const std::array<Vec3, 3>& t, const Vec3& normal, double distance2) const {
    const Vec3 to = from_ + way_;
    for (std::size_t at = 0; at < 3; ++at) {
      const Vec3 &a = t[at], &b = t[(at + 1) % 3];
      if (segment_distance2(from_, way_, a, b - a) < distance2) return true;
      if (ray_distance2(from_, a, b) < distance2 || above_distance2(a) < distance2) return true;
      if (plan2_ > 0 && (ray_distance2(to, a, b) < distance2 || crosses(a, b))) return true;
    }
    return is_near_inside(from_, t, normal, distance2) || (plan2_ > 0 && is_near_inside(to, t, normal, distance2));
  }

 private:
  /// Straight across, of a point that is above the way.
  double above_distance2(const Vec3& point) const {
    if (plan2_ == 0) return infinity;
    const double du = point.x() - from_.x(), dv = point.y() - from_.y();
    const double along = du * way_.x() + dv * way_.y();
    if (along < 0 || along > plan2_ || (point.z() - from_.z()) * plan2_ < along * way_.z()) return infinity;
    const double side = du * way_.y() - dv * way_.x();
    return side * side / plan2_;
  }
  bool crosses(const Vec3& a, const Vec3& b) const {
    const auto side = [&](const Vec3& p) { return (p.x() - from_.x()) * way_.y() - (p.y() - from_.y()) * way_.x(); };
    const double first = side(a), second = side(b);
    if ((first > 0) == (second > 0)) return false;
    return above_distance2(a + (b - a) * (first / (first - second))) < infinity;
  }
  /// From an end, straight onto the inside of the triangle; or the triangle is above the end.
  bool is_near_inside(const Vec3& end, const std::array<Vec3, 3>& t, const Vec3& normal, double distance2) const {
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

  Vec3 from_, way_;
  double plan2_;
};

}  // namespace

FacetColumns::FacetColumns(const Mesh& part, const ToolFrame& frame) {
  Eigen::AlignedBox3d all;
  std::vector<Vec3> corners;
  corners.reserve(part.vertices.size());
  for (const Vec3& vertex : part.vertices) corners.push_back(frame.of(vertex));
  facets_.reserve(part.triangles.size());
  for (const auto& t : part.triangles) {
    Facet facet{{corners[t[0]], corners[t[1]], corners[t[2]]}, Vec3::Zero(), 0};
    facet.normal = (facet.corners[1] - facet.corners[0]).cross(facet.corners[2] - facet.corners[0]);
    const double area = facet.normal.norm();
    if (area > 0) facet.normal /= area;
    if (facet.normal.z() < 0) facet.normal = -facet.normal;
    facet.top = std::max({facet.corners[0].z(), facet.corners[1].z(), facet.corners[2].z()});
    for (const Vec3& corner : facet.corners) all.extend(corner);
    facets_.push_back(facet);
  }
  if (facets_.empty()) {
    begin_.assign(1, 0);
    return;
  }
  const double u = all.sizes().x(), v = all.sizes().y();
  step_ = std::max(
      {std::sqrt(facets_a_cell * u * v / static_cast<double>(facets_.size())), std::max(u, v) / max_along, 1e-6});
  low_u_ = all.min().x();
  low_v_ = all.min().y();
  width_ = static_cast<int>(u / step_) + 1;
  height_ = static_cast<int>(v / step_) + 1;
  std::vector<std::uint32_t> order(facets_.size());
  for (std::uint32_t at = 0; at < order.size(); ++at) order[at] = at;
  std::ranges::stable_sort(order, std::ranges::greater{}, [this](std::uint32_t at) { return facets_[at].top; });
  begin_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 1, 0);
  const auto visit_cells = [&](const Facet& facet, const auto& visit) {
    const auto& c = facet.corners;
    for_each_cell(std::min({c[0].x(), c[1].x(), c[2].x()}), std::max({c[0].x(), c[1].x(), c[2].x()}),
                  std::min({c[0].y(), c[1].y(), c[2].y()}), std::max({c[0].y(), c[1].y(), c[2].y()}),
                  [&](std::size_t cell, double, double) { visit(cell); });
  };
  for (const Facet& facet : facets_) visit_cells(facet, [&](std::size_t cell) { ++begin_[cell + 1]; });
  for (std::size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
  listed_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (const std::uint32_t number : order) {
    const Listed facet = listed(number);
    visit_cells(facets_[number], [&](std::size_t cell) { listed_[next[cell]++] = facet; });
  }
}

FacetColumns::Listed FacetColumns::listed(std::uint32_t facet) const {
  const auto& c = facets_[facet].corners;
  return {below(std::min({c[0].x(), c[1].x(), c[2].x()}) - low_u_),
          above(std::max({c[0].x(), c[1].x(), c[2].x()}) - low_u_),
          below(std::min({c[0].y(), c[1].y(), c[2].y()}) - low_v_),
          above(std::max({c[0].y(), c[1].y(), c[2].y()}) - low_v_),
          facets_[facet].top,
          facet};
}

/// Calls `visit(cell, low u, low v)`.
template <typename Visit>
void FacetColumns::for_each_cell(double low_u, double high_u, double low_v, double high_v, const Visit& visit) const {
  const auto cell = [&](double at, double low) { return static_cast<int>(std::floor((at - low) / step_)); };
  const int first_a = std::max(0, cell(low_u, low_u_)), last_a = std::min(width_ - 1, cell(high_u, low_u_));
  const int first_b = std::max(0, cell(low_v, low_v_)), last_b = std::min(height_ - 1, cell(high_v, low_v_));
  for (int b = first_b; b <= last_b; ++b)
    for (int a = first_a; a <= last_a; ++a)
      visit(static_cast<std::size_t>(b) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(a),
            low_u_ + a * step_, low_v_ + b * step_);
}

/// The lowest that a ball may be over one facet; `height` where that is higher.
double FacetColumns::rest_on(const Facet& facet, double u, double v, double radius, double height) {
  const auto& t = facet.corners;
  const Vec3& n = facet.normal;
  if (n.z() > upright) {
    const double z = t[0].z() + (radius - n.x() * (u - t[0].x()) - n.y() * (v - t[0].y())) / n.z();
    if (z <= height) return height;  // the plane is the higher bound
    if (covers(t, u - radius * n.x(), v - radius * n.y())) return z;
  }
  for (std::size_t edge = 0; edge < 3; ++edge) {
    height = over_corner(t[edge], u, v, radius * radius, height);
    height = over_edge(t[edge], t[(edge + 1) % 3], u, v, radius * radius, height);
  }
  return height;
}

double FacetColumns::rest_height(double u, double v, double radius, double from, double enough) const {
  const double r2 = radius * radius, from_u = u - low_u_, from_v = v - low_v_;
  double height = from;
  const auto look = [&](std::size_t cell, double lift) {
    for (std::uint32_t at = begin_[cell]; at < begin_[cell + 1]; ++at) {
      const Listed& facet = listed_[at];
      if (facet.top + lift <= height) return;
      const double off_u = outside(from_u, facet.low_u, facet.high_u),
                   off_v = outside(from_v, facet.low_v, facet.high_v), left = r2 - off_u * off_u - off_v * off_v;
      if (left < 0 || (height > facet.top && (height - facet.top) * (height - facet.top) >= left)) continue;
      height = rest_on(facets_[facet.facet], u, v, radius, height);
    }
  };
  for_each_cell(u, u, v, v, [&](std::size_t cell, double, double) { look(cell, radius); });
  if (height > enough) return height;
  for_each_cell(u - radius, u + radius, v - radius, v + radius, [&](std::size_t cell, double cell_u, double cell_v) {
    const double du = std::max({0.0, cell_u - u, u - cell_u - step_}),
                 dv = std::max({0.0, cell_v - v, v - cell_v - step_}), left = r2 - du * du - dv * dv;
    if (left > 0 && height <= enough) look(cell, std::sqrt(left));
  });
  return height;
}

bool FacetColumns::is_clear(const Vec3& from, const Vec3& to, double radius) const {
  const Curtain curtain(from, to);
  const double r2 = radius * radius, lowest = std::min(from.z(), to.z());
  const double low_u = std::min(from.x(), to.x()), high_u = std::max(from.x(), to.x());
  const double low_v = std::min(from.y(), to.y()), high_v = std::max(from.y(), to.y());
  const double beyond = radius + rounding_m, beyond2 = beyond * beyond;
  const auto lower_of = [](const Vec3& n, const Vec3& a, const Vec3& b) { return n.dot(a) < n.dot(b) ? a : b; };
  const Vec3 way = to - from;
  const double length = way.head<2>().norm();
  const Point2 across = length > 0 ? Point2(-way.y() / length, way.x() / length) : Point2::Zero();
  const double begin_across = across.dot(from.head<2>() - Point2(low_u_, low_v_));
  // In plan, of the box around a facet from the way: no farther than this.
  const auto plan_off2 = [&](const Listed& facet) {
    const double off_u = std::max({0.0, facet.low_u - (high_u - low_u_), low_u - low_u_ - facet.high_u}),
                 off_v = std::max({0.0, facet.low_v - (high_v - low_v_), low_v - low_v_ - facet.high_v});
    const double middle = across.x() * (facet.low_u + facet.high_u) / 2 + across.y() * (facet.low_v + facet.high_v) / 2,
                 half = std::abs(across.x()) * (facet.high_u - facet.low_u) / 2 +
                        std::abs(across.y()) * (facet.high_v - facet.low_v) / 2;
    const double aside = std::max(0.0, std::abs(middle - begin_across) - half);
    return std::max(off_u * off_u + off_v * off_v, aside * aside);
  };
  bool clear = true;
  for_each_cell(low_u - radius, high_u + radius, low_v - radius, high_v + radius,
                [&](std::size_t cell, double cell_u, double cell_v) {
                  const double du = std::max({0.0, cell_u - high_u, low_u - cell_u - step_}),
                               dv = std::max({0.0, cell_v - high_v, low_v - cell_v - step_}),
                               left = r2 - du * du - dv * dv;
                  if (left <= 0) return;
                  const double lift = std::sqrt(left);
                  for (std::uint32_t at = begin_[cell]; clear && at < begin_[cell + 1]; ++at) {
                    const Listed& listed = listed_[at];
                    if (listed.top + lift <= lowest) return;
                    const double off2 = plan_off2(listed);
                    if (off2 > beyond2) continue;
                    if (lowest > listed.top && (lowest - listed.top) * (lowest - listed.top) + off2 > beyond2) continue;
                    const Facet& facet = facets_[listed.facet];
                    // All of it is above the facet's plane, and farther from it: normals look upwards.
                    const Vec3& n = facet.normal;
                    if (n.dot(lower_of(n, from, to) - facet.corners[0]) > beyond) continue;
                    clear = !curtain.is_nearer(facet.corners, facet.normal, r2);
                  }
                });
  return clear;
}

}  // namespace sculpt
