#include "core/material/crossings.hpp"

#include <algorithm>
#include <cmath>

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

/// Flips the bits where a surface is entered or left.
class Toggles {
 public:
  Toggles(Crossings& out, int n, int axis) : out_(out), n_(n) {
    const std::array<std::size_t, 3> stride{1, static_cast<std::size_t>(n), static_cast<std::size_t>(n) * n};
    along_ = stride[axis];
    across_a_ = stride[(axis + 1) % 3];
    across_b_ = stride[(axis + 2) % 3];
  }
  void add(std::int64_t a, std::int64_t b, std::int64_t c) {
    const std::size_t column = static_cast<std::size_t>(a + n_ * b);
    out_.met[column >> 6] |= std::uint64_t{1} << (column & 63);
    out_.odd[column >> 6] ^= std::uint64_t{1} << (column & 63);
    if (c >= n_) return;
    const std::size_t at = a * across_a_ + b * across_b_ + std::max<std::int64_t>(c, 0) * along_;
    out_.inside.words()[at >> 6] ^= std::uint64_t{1} << (at & 63);
  }

 private:
  Crossings& out_;
  std::int64_t n_;
  std::size_t along_, across_a_, across_b_;
};

void add_triangle(const std::array<Point, 3>& t, int n, Toggles& toggles) {
  const std::int64_t b_low = std::max<std::int64_t>(first_centre(std::min({t[0].b, t[1].b, t[2].b})), 0);
  const std::int64_t b_high = std::min<std::int64_t>(first_centre(std::max({t[0].b, t[1].b, t[2].b})), n);
  if (b_low >= b_high) return;
  const Plane plane(t);
  for (std::int64_t row = b_low; row < b_high; ++row) {
    const std::int64_t b = row * unit + half;
    std::array<std::int64_t, 2> ends{};
    int met = 0;
    for (int e = 0; e < 3; ++e) {
      const Point &p = t[e], &q = t[(e + 1) % 3];
      if ((p.b <= b) != (q.b <= b)) ends[met++] = first_column(p, q, b);  // never more than two of three edges
    }
    if (met < 2) continue;
    const std::int64_t last = std::min<std::int64_t>(std::max(ends[0], ends[1]), n);
    for (std::int64_t column = std::max<std::int64_t>(std::min(ends[0], ends[1]), 0); column < last; ++column)
      toggles.add(column, row, plane.first_voxel(column * unit + half, b));
  }
}

/// The bits of a word that have at least `shift` bits of their own span (a power of two of bits) below them.
std::uint64_t reach_of(std::size_t shift, std::size_t span) {
  std::uint64_t reach = 0;
  for (std::size_t bit = 0; bit < 64; ++bit)
    if (bit % span >= shift) reach |= std::uint64_t{1} << bit;
  return reach;
}

/// Columns that step from bit to bit inside a word.
void prefix_parity_narrow(std::vector<std::uint64_t>& words, std::size_t stride, std::size_t span) {
  const std::size_t in_word = std::min<std::size_t>(span, 64), words_a_span = span / in_word;
  std::array<std::uint64_t, 7> reach{};
  for (std::size_t s = 0; stride << s < in_word; ++s) reach[s] = reach_of(stride << s, in_word);
  std::uint64_t repeat = 0;  // copies the lowest `stride` bits all over a word
  for (std::size_t bit = 0; bit < 64; bit += stride) repeat |= std::uint64_t{1} << bit;
  for (std::size_t first = 0; first < words.size(); first += words_a_span) {
    std::uint64_t carry = 0;
    for (std::size_t at = first; at < first + words_a_span; ++at) {
      std::uint64_t word = words[at];
      for (std::size_t s = 0; stride << s < in_word; ++s) word ^= (word << (stride << s)) & reach[s];
      words[at] = word ^ (carry * repeat);
      carry = words[at] >> (64 - stride);
    }
  }
}

/// Each bit becomes the parity of itself and all bits before it in its column: columns step by `stride` bits and fill
/// `span` bits.
void prefix_parity(std::vector<std::uint64_t>& words, std::size_t stride, std::size_t span) {
  if (stride < 64) return prefix_parity_narrow(words, stride, span);
  const std::size_t step = stride / 64, block = span / 64;
  for (std::size_t first = 0; first < words.size(); first += block)
    for (std::size_t at = first + step; at < first + block; ++at) words[at] ^= words[at - step];
}

}  // namespace

FixedMesh to_fixed(const Mesh& mesh, const Grid& grid) {
  constexpr double limit = 8192;  // voxels; products of two coordinates then stay below 2^62
  FixedMesh fixed;
  fixed.triangles = mesh.triangles;
  fixed.vertices.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) {
    const Vec3 at = (vertex - grid.origin_m) / grid.voxel_m;
    if (!(at.cwiseAbs().maxCoeff() < limit))
      throw InputError(
          "target_outside_stock",
          "the mesh reaches more than 8192 voxels out of the grid: check its units (metres) and its place");
    fixed.vertices.push_back({std::llround(at.x() * unit), std::llround(at.y() * unit), std::llround(at.z() * unit)});
  }
  return fixed;
}

Crossings find_crossings(const FixedMesh& mesh, int n, int axis, const Watch& watch) {
  Crossings crossings{VoxelSet(n), {}, {}};
  crossings.met.resize(static_cast<std::size_t>(n) * n / 64);
  crossings.odd = crossings.met;
  Toggles toggles(crossings, n, axis);
  const std::uint64_t count = mesh.triangles.size();
  for (std::uint64_t t = 0; t < count; ++t) {
    if (t % 1024 == 0) watch.step(Stage::voxelize, axis * count + t, 3 * count);
    std::array<Point, 3> points;
    for (int corner = 0; corner < 3; ++corner) {
      const auto& at = mesh.vertices[mesh.triangles[t][corner]];
      points[corner] = {at[(axis + 1) % 3], at[(axis + 2) % 3], at[axis]};
    }
    add_triangle(points, n, toggles);
  }
  const std::size_t edge = static_cast<std::size_t>(n);
  const std::array<std::size_t, 4> stride{1, edge, edge * edge, edge * edge * edge};
  prefix_parity(crossings.inside.words(), stride[axis], stride[axis + 1]);
  return crossings;
}

}  // namespace sculpt
