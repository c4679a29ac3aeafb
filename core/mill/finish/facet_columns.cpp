#include "core/mill/finish/facet_columns.hpp"

#include <algorithm>
#include <cmath>

#include "core/mill/finish/curtain.hpp"
#include "core/mill/finish/seen_from_above.hpp"
#include "core/mill/map/float_bound.hpp"

namespace sculpt {
namespace {

/// Cells: about so many facets each, and at most so many along a side.
constexpr double facets_a_cell = 16, max_along = 1024;
/// More than coordinates of a stock are rounded by.
constexpr double rounding_m = 1e-9;

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

/// How far a value is outside of a range.
double outside(double value, double low, double high) {
  return std::max({0.0, low - value, value - high});
}

}  // namespace

FacetColumns::FacetColumns(const Mesh& part, const ToolFrame& frame) : part_(part) {
  vertices_.reserve(part.vertices.size());
  for (const Vec3& vertex : part.vertices) vertices_.push_back(frame.of(vertex));
  Eigen::AlignedBox3d all;
  normals_.reserve(part.triangles.size());
  for (std::uint32_t facet = 0; facet < part.triangles.size(); ++facet) {
    const Triangle t = corners(facet);
    for (const Vec3& corner : t) all.extend(corner);
    Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if (const double area = normal.norm(); area > 0) normal /= area;
    normals_.emplace_back(normal.z() < 0 ? -normal : normal);
  }
  if (normals_.empty()) {
    begin_.assign(1, 0);
    return;
  }
  const double u = all.sizes().x(), v = all.sizes().y();
  step_ = std::max(
      {std::sqrt(facets_a_cell * u * v / static_cast<double>(normals_.size())), std::max(u, v) / max_along, 1e-6});
  low_u_ = all.min().x();
  low_v_ = all.min().y();
  width_ = static_cast<int>(u / step_) + 1;
  height_ = static_cast<int>(v / step_) + 1;
  list_facets();
}

/// In each cell that they may be over, the highest first.
void FacetColumns::list_facets() {
  begin_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 1, 0);
  const auto visit_cells = [&](std::uint32_t facet, const auto& visit) {
    const auto [a, b, c] = corners(facet);
    const auto [low_u, high_u] = std::minmax({a.x(), b.x(), c.x()});
    const auto [low_v, high_v] = std::minmax({a.y(), b.y(), c.y()});
    for_each_cell(low_u, high_u, low_v, high_v, [&](std::size_t cell, double, double) { visit(cell); });
  };
  const auto count = static_cast<std::uint32_t>(normals_.size());
  for (std::uint32_t facet = 0; facet < count; ++facet)
    visit_cells(facet, [&](std::size_t cell) { ++begin_[cell + 1]; });
  for (std::size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
  listed_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t facet = 0; facet < count; ++facet) {
    const Listed entry = listed(facet);
    visit_cells(facet, [&](std::size_t cell) { listed_[next[cell]++] = entry; });
  }
  for (std::size_t cell = 0; cell + 1 < begin_.size(); ++cell)
    std::sort(listed_.begin() + begin_[cell], listed_.begin() + begin_[cell + 1],
              [](const Listed& a, const Listed& b) { return a.top != b.top ? a.top > b.top : a.facet < b.facet; });
}

FacetColumns::Listed FacetColumns::listed(std::uint32_t facet) const {
  const auto [a, b, c] = corners(facet);
  const auto [low_u, high_u] = std::minmax({a.x(), b.x(), c.x()});
  const auto [low_v, high_v] = std::minmax({a.y(), b.y(), c.y()});
  return {below(low_u - low_u_),
          above(high_u - low_u_),
          below(low_v - low_v_),
          above(high_v - low_v_),
          above(std::max({a.z(), b.z(), c.z()})),
          facet};
}

std::size_t FacetColumns::bytes() const {
  return (vertices_.capacity() + normals_.capacity()) * sizeof(Vec3) + begin_.capacity() * sizeof(begin_[0]) +
         listed_.capacity() * sizeof(Listed);
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
double FacetColumns::rest_on(std::uint32_t facet, double u, double v, double radius, double height) const {
  const Triangle t = corners(facet);
  const Vec3& n = normals_[facet];
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
      const auto top = static_cast<double>(facet.top);
      if (top + lift <= height) return;
      const double off_u = outside(from_u, facet.low_u, facet.high_u),
                   off_v = outside(from_v, facet.low_v, facet.high_v), left = r2 - off_u * off_u - off_v * off_v;
      if (left < 0 || (height > top && (height - top) * (height - top) >= left)) continue;
      height = rest_on(facet.facet, u, v, radius, height);
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

/// A straight way as seen from above.
class FacetColumns::PlanWay {
 public:
  /// Coordinates of the first cell's corner.
  PlanWay(const Vec3& from, const Vec3& to) : low_(from.cwiseMin(to).head<2>()), high_(from.cwiseMax(to).head<2>()) {
    const Point2 way = (to - from).head<2>();
    if (const double length = way.norm(); length > 0) across_ = Point2(-way.y(), way.x()) / length;
    begin_ = across_.dot(from.head<2>());
  }

  /// Of the box around a facet: no farther than this (m^2).
  double distance2(const Listed& facet) const {
    const double off_u = std::max({0.0, facet.low_u - high_.x(), low_.x() - facet.high_u}),
                 off_v = std::max({0.0, facet.low_v - high_.y(), low_.y() - facet.high_v});
    const double middle =
                     across_.x() * (facet.low_u + facet.high_u) / 2 + across_.y() * (facet.low_v + facet.high_v) / 2,
                 half = std::abs(across_.x()) * (facet.high_u - facet.low_u) / 2 +
                        std::abs(across_.y()) * (facet.high_v - facet.low_v) / 2;
    const double aside = std::max(0.0, std::abs(middle - begin_) - half);
    return std::max(off_u * off_u + off_v * off_v, aside * aside);
  }

 private:
  Point2 low_, high_, across_ = Point2::Zero();
  double begin_ = 0;  ///< across the way, where that is
};

bool FacetColumns::is_clear(const Vec3& from, const Vec3& to, double radius) const {
  const Curtain curtain(from, to);
  const PlanWay plan(from - Vec3(low_u_, low_v_, 0), to - Vec3(low_u_, low_v_, 0));
  const double r2 = radius * radius, lowest = std::min(from.z(), to.z());
  const double beyond = radius + rounding_m, beyond2 = beyond * beyond;
  const auto is_far = [&](const Listed& listed) {
    const double off2 = plan.distance2(listed), above = lowest - static_cast<double>(listed.top);
    return off2 > beyond2 || (above > 0 && above * above + off2 > beyond2);
  };
  // All of the way is above the facet's plane, and farther from it: normals look upwards.
  const auto is_below = [&](const Vec3& n, const Vec3& corner) {
    return std::min(n.dot(from), n.dot(to)) - n.dot(corner) > beyond;
  };
  bool clear = true;
  const auto look = [&](std::size_t cell, double lift) {
    for (std::uint32_t at = begin_[cell]; clear && at < begin_[cell + 1]; ++at) {
      const Listed& listed = listed_[at];
      if (static_cast<double>(listed.top) + lift <= lowest) return;
      if (is_far(listed)) continue;
      const Triangle t = corners(listed.facet);
      const Vec3& normal = normals_[listed.facet];
      clear = is_below(normal, t[0]) || !curtain.is_nearer(t, normal, r2);
    }
  };
  const double low_u = std::min(from.x(), to.x()), high_u = std::max(from.x(), to.x());
  const double low_v = std::min(from.y(), to.y()), high_v = std::max(from.y(), to.y());
  for_each_cell(low_u - radius, high_u + radius, low_v - radius, high_v + radius,
                [&](std::size_t cell, double cell_u, double cell_v) {
                  const double du = std::max({0.0, cell_u - high_u, low_u - cell_u - step_}),
                               dv = std::max({0.0, cell_v - high_v, low_v - cell_v - step_}),
                               left = r2 - du * du - dv * dv;
                  if (left > 0) look(cell, std::sqrt(left));
                });
  return clear;
}

}  // namespace sculpt
