#include "core/verify/mill/surface_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace sculpt {
namespace {

constexpr double points_a_mm2 = 2;
constexpr double fewest = 20000, most = 250000;
constexpr double uncut = std::numeric_limits<double>::infinity();
constexpr double gouge_mm = 1e-3;
/// The part stands on what is no higher than this above the bottom of the block and steeper to the side than 1 in 2.
constexpr double base_mm = 1, base_lean = 0.5;
/// From a point to a segment, squared.
double away2(const Vec3& point, const Vec3& from, const Vec3& way) {
  const double length2 = way.squaredNorm();
  const double share = length2 > 0 ? std::clamp((point - from).dot(way) / length2, 0.0, 1.0) : 0;
  return (point - from - share * way).squaredNorm();
}

/// How far along the ray of unit vector `ray` from `off`, as seen from its middle, a ball is entered from outside.
double enter_ball(const Vec3& off, const Vec3& ray, double radius) {
  const double b = off.dot(ray), inside = b * b - (off.squaredNorm() - radius * radius);
  return b < 0 && inside >= 0 ? -b - std::sqrt(inside) : uncut;
}

/// The same for all that a ball is in on its middle's way: where the ray meets the ball at either end, or in between
/// the cylinder about the way.
double enter_swept(const Vec3& point, const Vec3& ray, const Vec3& from, const Vec3& way, double radius) {
  const Vec3 off = point - from;
  const double ends = std::min(enter_ball(off, ray, radius), enter_ball(off - way, ray, radius));
  const double length2 = way.squaredNorm();
  if (!(length2 > 0)) return ends;
  const Vec3 off_across = off - off.dot(way) / length2 * way, ray_across = ray - ray.dot(way) / length2 * way;
  const double a = ray_across.squaredNorm(), b = off_across.dot(ray_across),
               c = off_across.squaredNorm() - radius * radius, inside = b * b - a * c;
  if (!(a > 0) || c < 0 || b >= 0 || inside < 0) return ends;
  const double there = (-b - std::sqrt(inside)) / a, along = (off + there * ray).dot(way);
  return along >= 0 && along <= length2 ? std::min(ends, there) : ends;
}

bool contains(const VoxelSet& voxels, const Grid& grid, const Vec3& at_mm) {
  const Vec3 at = (at_mm / 1000 - grid.origin_m) / grid.voxel_m;
  if ((at.array() < 0).any() || (at.array() >= grid.n).any()) return false;
  return voxels.contains({static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())});
}

/// From a point along a unit vector to the side of the block; no stock is beyond.
double way_out(const Vec3& at_mm, const Vec3& normal, const Grid& grid) {
  const Vec3 low = 1000 * grid.origin_m, high = low + Vec3::Constant(1000 * grid.n * grid.voxel_m);
  double way = uncut;
  for (int axis = 0; axis < 3; ++axis) {
    if (normal[axis] > 0) way = std::min(way, (high[axis] - at_mm[axis]) / normal[axis]);
    if (normal[axis] < 0) way = std::min(way, (low[axis] - at_mm[axis]) / normal[axis]);
  }
  return std::max(0.0, way);
}

bool is_base(const Vec3& at_mm, const Vec3& normal, const Grid& grid) {
  return at_mm.z() - 1000 * grid.origin_m.z() <= base_mm && normal.z() < 0 &&
         normal.head<2>().norm() <= base_lean * -normal.z();
}

}  // namespace

std::optional<Vec3> outward(const Vec3& at, const Vec3& normal, const VoxelGrid& voxels, const Grid& grid) {
  const double voxel = 1000 * grid.voxel_m;
  const auto is_inside = [&](double above) { return contains(voxels.keep, grid, at + above * normal); };
  const bool before = is_inside(voxel), behind = is_inside(-voxel);
  if (before && behind && is_inside(2 * voxel) && is_inside(-2 * voxel)) return std::nullopt;
  return before && !behind ? -normal : normal;
}

std::vector<SurfacePoint> draw_points(const Mesh& part, const VoxelGrid& voxels, const Grid& grid) {
  std::vector<double> weights;
  double area = 0, volume = 0;
  for (const auto& t : part.triangles) {
    const Vec3 &a = part.vertices[t[0]], &b = part.vertices[t[1]], &c = part.vertices[t[2]];
    weights.push_back((b - a).cross(c - a).norm() / 2);
    area += weights.back();
    volume += a.dot(b.cross(c));
  }
  std::vector<SurfacePoint> found;
  if (!(area > 0)) return found;
  std::mt19937_64 random(20261123);
  std::discrete_distribution<std::size_t> facets(weights.begin(), weights.end());
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto count = static_cast<std::size_t>(std::clamp(1e6 * area * points_a_mm2, fewest, most));
  for (std::size_t drawn = 0; drawn < count; ++drawn) {
    const auto& t = part.triangles[facets(random)];
    const Vec3 a = 1000 * part.vertices[t[0]], b = 1000 * part.vertices[t[1]], c = 1000 * part.vertices[t[2]];
    const double root = std::sqrt(unit()), share = unit();
    const Vec3 at = (1 - root) * a + root * ((1 - share) * b + share * c);
    const Vec3 normal = (b - a).cross(c - a).normalized();
    if (const auto out = outward(at, volume < 0 ? Vec3(-normal) : normal, voxels, grid))
      found.push_back({at, *out, is_base(at, *out, grid)});
  }
  return found;
}

SurfacePoints::SurfacePoints(const std::vector<SurfacePoint>& points, const Grid& grid, double near_mm)
    : grid_(grid), near_mm_(near_mm) {
  if (points.empty()) return;
  Eigen::AlignedBox3d all;
  for (const SurfacePoint& point : points) all.extend(point.at);
  low_ = all.min();
  const double size = all.sizes().maxCoeff();
  edge_ = std::max({size / 400, size / std::sqrt(static_cast<double>(points.size())), 1e-6});
  boxes_ = (all.sizes().array() / edge_).cast<int>() + 1;
  begin_.assign(
      static_cast<std::size_t>(boxes_[0]) * static_cast<std::size_t>(boxes_[1]) * static_cast<std::size_t>(boxes_[2]) +
          1,
      0);
  for (const SurfacePoint& point : points) ++begin_[box_of(point.at) + 1];
  for (std::size_t box = 1; box < begin_.size(); ++box) begin_[box] += begin_[box - 1];
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  points_.resize(points.size());
  for (std::size_t number = 0; number < points.size(); ++number)
    points_[next[box_of(points[number].at)]++] = {points[number].at, points[number].normal, uncut,
                                                  points[number].is_base, number};
}

std::size_t SurfacePoints::box_of(const Vec3& at) const {
  const Eigen::Array3i box = ((at - low_).array() / edge_).floor().cast<int>().max(0).min(boxes_ - 1);
  return static_cast<std::size_t>(box[0]) +
         static_cast<std::size_t>(boxes_[0]) * (static_cast<std::size_t>(box[1]) +
                                                static_cast<std::size_t>(boxes_[1]) * static_cast<std::size_t>(box[2]));
}

void SurfacePoints::cut(const Vec3& from, const Vec3& to, double radius, double stray) {
  if (points_.empty()) return;
  const Vec3 way = to - from;
  const Eigen::Array3d room = Eigen::Array3d::Constant(radius + near_mm_);
  const Eigen::Array3d low = from.array().min(to.array()) - room, high = from.array().max(to.array()) + room;
  const Eigen::Array3d top = low_.array() + edge_ * boxes_.cast<double>();
  if ((high < low_.array()).any() || (low > top).any()) return;
  const Eigen::Array3i first = ((low - low_.array()) / edge_).floor().cast<int>().max(0),
                       last = ((high - low_.array()) / edge_).floor().cast<int>().min(boxes_ - 1);
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j) {
      const std::size_t row =
          static_cast<std::size_t>(boxes_[0]) *
          (static_cast<std::size_t>(j) + static_cast<std::size_t>(boxes_[1]) * static_cast<std::size_t>(k));
      const std::uint32_t end = begin_[row + static_cast<std::size_t>(last[0]) + 1];
      for (std::uint32_t at = begin_[row + static_cast<std::size_t>(first[0])]; at < end; ++at)
        cut(points_[at], from, way, radius, stray);
    }
}

void SurfacePoints::cut(Point& point, const Vec3& from, const Vec3& way, double radius, double stray) {
  const double surely = radius - stray;
  const double most = std::min(point.excess, near_mm_), reach = std::max(radius + stray, surely + most);
  const double here2 = away2(point.at, from, way);
  if (here2 > reach * reach) return;  // along the normal it comes no nearer than by as much as it goes
  const double here = std::sqrt(here2);
  if (radius + stray - here > gouge_mm) {
    ++gouged_;
    deepest_ = std::max(deepest_, radius + stray - here);
  }
  const double there = here < surely ? 0 : enter_swept(point.at, point.normal, from, way, surely);
  if (there < most) point.excess = there;
}

SurfaceVerdict SurfacePoints::judge(const VoxelSet& standing) const {
  SurfaceVerdict verdict;
  verdict.gouged_points = gouged_;
  verdict.gouge_m = deepest_ / 1000;
  const double coarse = 1000 * grid_.voxel_m / 4;
  std::vector<std::optional<double>> excess_m(points_.size());
  for (const Point& point : points_) {
    if (point.is_base) continue;
    double excess = point.excess;
    if (excess == uncut)
      for (excess = gouge_mm; contains(standing, grid_, point.at + excess * point.normal);)
        excess += std::min(coarse, 0.01 + excess / 4);
    excess_m[point.number] = std::min(excess, way_out(point.at, point.normal, grid_)) / 1000;
  }
  for (const auto& excess : excess_m)
    if (excess)
      verdict.excess_m.push_back(*excess);
    else
      ++verdict.base_points;
  return verdict;
}

}  // namespace sculpt
