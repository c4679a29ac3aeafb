#include "core/solid/find_crossings.hpp"

#include <algorithm>
#include <cmath>

#include "core/solid/column_fill.hpp"
#include "core/solid/prefix_parity.hpp"

namespace sculpt {
namespace {

constexpr std::int64_t unit = std::int64_t{1} << unit_bits;
constexpr std::int64_t half = unit / 2;

/// Index of the first voxel centre at or after `at`, in units.
std::int64_t first_centre(std::int64_t at) {
  return (at + half - 1) >> unit_bits;
}

std::int64_t floor_div(std::int64_t a, std::int64_t b) {  // b > 0
  const std::int64_t quotient = a / b;
  return quotient - (a % b < 0 ? 1 : 0);
}

/// A vertex seen along the axis: (a, b) across, c along.
struct Point {
  std::int64_t a, b, c;
};

/// First column centre at or after the point where the edge p q meets the line `b`; exact, and the same for both
/// triangles of the edge.
std::int64_t first_column(Point p, Point q, std::int64_t b) {
  if (p.b > q.b) std::swap(p, q);
  const std::int64_t offset = (b - p.b) * (q.a - p.a), length = q.b - p.b;
  // ceil(p.a + offset / length) is the smallest integer at or after the crossing, and centres are integers.
  return first_centre(p.a - floor_div(-offset, length));
}

/// Depth along the column over the triangle's plane, never outside the triangle's own range.
class Plane {
 public:
  explicit Plane(const std::array<Point, 3>& t)
      : origin_(t[0]), low_(std::min({t[0].c, t[1].c, t[2].c})), high_(std::max({t[0].c, t[1].c, t[2].c})) {
    const std::int64_t ua = t[1].a - t[0].a, ub = t[1].b - t[0].b, uc = t[1].c - t[0].c;
    const std::int64_t va = t[2].a - t[0].a, vb = t[2].b - t[0].b, vc = t[2].c - t[0].c;
    const std::int64_t area = ua * vb - ub * va;
    if (area == 0) return;
    slope_a_ = static_cast<double>(uc * vb - ub * vc) / static_cast<double>(area);
    slope_b_ = static_cast<double>(ua * vc - uc * va) / static_cast<double>(area);
  }
  /// Index of the first voxel centre at or after the surface in column (a, b), units.
  std::int64_t first_voxel(std::int64_t a, std::int64_t b) const {
    const double depth = static_cast<double>(origin_.c) + slope_a_ * static_cast<double>(a - origin_.a) +
                         slope_b_ * static_cast<double>(b - origin_.b);
    const double held = std::clamp(depth, static_cast<double>(low_), static_cast<double>(high_));
    return first_centre(static_cast<std::int64_t>(std::ceil(held)));
  }

 private:
  Point origin_;
  std::int64_t low_, high_;
  double slope_a_ = 0, slope_b_ = 0;
};

/// A facet seen along the axis, while the rows of columns go over it.
struct Facet {
  std::array<Point, 3> corners;
  Plane plane;
  std::int64_t end;  ///< first row behind it
  Role role;
  bool enters;  ///< a column going up the axis goes in through it
};

bool enters(const std::array<Point, 3>& t) {
  return (t[1].a - t[0].a) * (t[2].b - t[0].b) < (t[1].b - t[0].b) * (t[2].a - t[0].a);
}

void cross(const Facet& facet, std::int64_t row, int n, std::vector<Crossing>& crossings) {
  const std::int64_t b = row * unit + half;
  std::array<std::int64_t, 2> ends{};
  int met = 0;
  for (int e = 0; e < 3; ++e) {
    const Point &p = facet.corners[e], &q = facet.corners[(e + 1) % 3];
    if ((p.b <= b) != (q.b <= b)) ends[met++] = first_column(p, q, b);  // never more than two of three edges
  }
  if (met < 2) return;
  const std::int64_t last = std::min<std::int64_t>(std::max(ends[0], ends[1]), n);
  for (std::int64_t a = std::max<std::int64_t>(std::min(ends[0], ends[1]), 0); a < last; ++a) {
    const std::int64_t depth = facet.plane.first_voxel(a * unit + half, b);
    crossings.emplace_back(a, std::clamp<std::int64_t>(depth, 0, n), n, facet.role, facet.enters);
  }
}

/// Facets of a surface that meet rows of columns, by the first row.
class Rows {
 public:
  Rows(const Surface& surface, int n, int axis) : surface_(surface), n_(n), axis_(axis), first_(n + 1, 0) {
    const auto count = static_cast<std::uint32_t>(surface.mesh.triangles.size());
    for (std::uint32_t t = 0; t < count; ++t)
      if (const auto row = first_row(t); row < last_row(t)) ++first_[row + 1];
    for (int row = 0; row < n; ++row) first_[row + 1] += first_[row];
    facets_.resize(first_[n]);
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t t = 0; t < count; ++t)
      if (const auto row = first_row(t); row < last_row(t)) facets_[next[row]++] = t;
  }

  /// Adds those that begin in the row, and takes out those that ended before it.
  void go_to(int row, std::vector<Facet>& active) const {
    std::erase_if(active, [&](const Facet& facet) { return facet.end <= row; });
    for (std::uint32_t at = first_[row]; at < first_[row + 1]; ++at) {
      const std::uint32_t t = facets_[at];
      std::array<Point, 3> corners;
      for (int corner = 0; corner < 3; ++corner) {
        const auto& v = surface_.mesh.vertices[surface_.mesh.triangles[t][corner]];
        corners[corner] = {v[(axis_ + 1) % 3], v[(axis_ + 2) % 3], v[axis_]};
      }
      active.push_back({corners, Plane(corners), last_row(t), surface_.role[t], enters(corners)});
    }
  }

 private:
  std::int64_t b(std::uint32_t facet, int corner) const {
    return surface_.mesh.vertices[surface_.mesh.triangles[facet][corner]][(axis_ + 2) % 3];
  }
  std::int64_t first_row(std::uint32_t t) const {
    return std::max<std::int64_t>(first_centre(std::min({b(t, 0), b(t, 1), b(t, 2)})), 0);
  }
  std::int64_t last_row(std::uint32_t t) const {
    return std::min<std::int64_t>(first_centre(std::max({b(t, 0), b(t, 1), b(t, 2)})), n_);
  }

  const Surface& surface_;
  int n_, axis_;
  std::vector<std::uint32_t> first_;  // of each row: where its facets begin in `facets_`
  std::vector<std::uint32_t> facets_;
};

}  // namespace

Crossings find_crossings(const Surface& surface, int n, int axis, const Watch& watch) {
  constexpr std::size_t max_a_column = 10000;
  Crossings crossings{VoxelSet(n), {}, {}, 0, {}};
  crossings.met.resize(static_cast<std::size_t>(n) * n / 64);
  crossings.odd = crossings.met;
  ColumnFill columns(crossings, n, axis);
  const Rows rows(surface, n, axis);
  std::vector<Facet> active;
  std::vector<Crossing> met;
  for (int row = 0; row < n; ++row) {
    rows.go_to(row, active);
    met.clear();
    for (std::size_t at = 0; at < active.size(); ++at) {
      if (at % 1024 == 0) watch.step(Stage::voxelize, axis * n + row, 3 * n);
      cross(active[at], row, n, met);
      if (met.size() > max_a_column * static_cast<std::size_t>(n))
        throw InputError("mesh_not_solid",
                         "the mesh is not a solid: its facets lie in one another, more than 10000 deep: "
                         "remove those that are there many times");
    }
    std::sort(met.begin(), met.end());
    for (std::size_t first = 0, end = 0; first < met.size(); first = end) {
      while (end < met.size() && met[end].column(n) == met[first].column(n)) ++end;
      columns.add({&met[first], end - first}, row);
    }
  }
  const std::size_t edge = static_cast<std::size_t>(n);
  const std::array<std::size_t, 4> stride{1, edge, edge * edge, edge * edge * edge};
  prefix_parity(crossings.inside.words(), stride[axis], stride[axis + 1]);
  return crossings;
}

}  // namespace sculpt
