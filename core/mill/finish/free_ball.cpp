#include "core/mill/finish/free_ball.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace sculpt {
namespace {

constexpr int max_pushes = 40;
/// Pushed so much farther than it must be, so that it comes to an end; after some pushes by a share as well, as between
/// walls at a small angle each brings little.
constexpr double beyond_m = 2e-7, beyond_share = 0.3;
constexpr int patient_pushes = 8;

/// Of a triangle, by where `p` is about its corners, edges and inside (Ericson, "Real-Time Collision Detection", 2005,
/// section 5.1.5).
Vec3 nearest_on(const std::array<Vec3, 3>& t, const Vec3& p) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return t[0];
  if (d3 >= 0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t[0] + d1 / std::max(d1 - d3, 1e-300) * ab;
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t[0] + d2 / std::max(d2 - d6, 1e-300) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6)
    return t[1] + (d4 - d3) / std::max((d4 - d3) + (d5 - d6), 1e-300) * (t[2] - t[1]);
  const double sum = va + vb + vc;
  return t[0] + vb / sum * ab + vc / sum * ac;
}

constexpr double far = std::numeric_limits<double>::infinity();

/// What Eigen::BVMinimize asks: the facet nearest to a point, of those that are nearer than at first `least2`.
struct NearestFacet {
  using Scalar = double;
  const std::vector<std::array<Vec3, 3>>& facets;
  const Vec3& to;
  double least2;
  std::optional<Vec3> at;

  double minimumOnVolume(const Eigen::AlignedBox3d& box) const {  // NOLINT(readability-identifier-naming)
    const double distance2 = box.squaredExteriorDistance(to);
    return distance2 < least2 ? distance2 : far;
  }
  double minimumOnObject(std::uint32_t facet) {  // NOLINT(readability-identifier-naming)
    const Vec3 found = nearest_on(facets[facet], to);
    const double distance2 = (found - to).squaredNorm();
    if (distance2 < least2) least2 = distance2, at = found;
    return distance2;
  }
};

}  // namespace

FreeBall::FreeBall(const Mesh& part) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const auto& t : part.triangles) {
    facets_.push_back({part.vertices[t[0]], part.vertices[t[1]], part.vertices[t[2]]});
    boxes.emplace_back();
    for (const Vec3& corner : facets_.back()) boxes.back().extend(corner);
  }
  std::vector<std::uint32_t> numbers(facets_.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  tree_.init(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
}

std::optional<Vec3> FreeBall::nearest(const Vec3& to, double within) const {
  NearestFacet asked{facets_, to, within * within, {}};
  Eigen::BVMinimize(tree_, asked);
  return asked.at;
}

std::optional<Vec3> FreeBall::push_out(Vec3 middle, double radius) const {
  for (int push = 0; push < max_pushes; ++push) {
    const std::optional<Vec3> touched = nearest(middle, radius);
    if (!touched) return middle;
    const Vec3 off = middle - *touched;
    const double distance = off.norm();
    if (distance == 0) return std::nullopt;
    const double more = beyond_m + (push < patient_pushes ? 0 : beyond_share * (radius - distance));
    middle += (radius - distance + more) / distance * off;
  }
  return std::nullopt;
}

}  // namespace sculpt
