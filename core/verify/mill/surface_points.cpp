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
/// Five millimetres so often halved are below a fifth of a micrometre.
constexpr int halvings = 15;

/// From a point to a segment.
double away(const Vec3& point, const Vec3& from, const Vec3& way) {
  const double length2 = way.squaredNorm();
  const double share = length2 > 0 ? std::clamp((point - from).dot(way) / length2, 0.0, 1.0) : 0;
  return (point - from - share * way).norm();
}

bool contains(const VoxelSet& voxels, const Grid& grid, const Vec3& at_mm) {
  const Vec3 at = (at_mm / 1000 - grid.origin_m) / grid.voxel_m;
  if ((at.array() < 0).any() || (at.array() >= grid.n).any()) return false;
  return voxels.contains({static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())});
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
    if (const auto out = outward(at, volume < 0 ? Vec3(-normal) : normal, voxels, grid)) found.push_back({at, *out});
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
    points_[next[box_of(points[number].at)]++] = {points[number].at, points[number].normal, uncut, number};
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
  const double surely = radius - stray;
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j) {
      const std::size_t row =
          static_cast<std::size_t>(boxes_[0]) *
          (static_cast<std::size_t>(j) + static_cast<std::size_t>(boxes_[1]) * static_cast<std::size_t>(k));
      const std::uint32_t end = begin_[row + static_cast<std::size_t>(last[0]) + 1];
      for (std::uint32_t at = begin_[row + static_cast<std::size_t>(first[0])]; at < end; ++at) {
        Point& point = points_[at];
        const double here = away(point.at, from, way);
        if (here > radius + near_mm_) continue;
        if (radius + stray - here > gouge_mm) {
          ++gouged_;
          deepest_ = std::max(deepest_, radius + stray - here);
        }
        if (here < surely) {
          point.excess = 0;
          continue;
        }
        // Along the normal the distance from the way is convex: first where it is least, then where the ball begins.
        double near = 0, far = std::min(point.excess, near_mm_);
        const double there = away(point.at + far * point.normal, from, way);
        if ((here + there - far) / 2 >= surely) continue;  // nowhere between: it changes by no more than the way
        if (there >= surely) {
          double begin = 0, end_of = far;
          for (int halving = 0; halving < 2 * halvings; ++halving) {
            const double third = (end_of - begin) / 3, a = begin + third, b = end_of - third;
            if (away(point.at + a * point.normal, from, way) < away(point.at + b * point.normal, from, way))
              end_of = b;
            else
              begin = a;
          }
          far = (begin + end_of) / 2;
          if (away(point.at + far * point.normal, from, way) >= surely) continue;
        }
        for (int halving = 0; halving < halvings; ++halving) {
          const double middle = (near + far) / 2;
          (away(point.at + middle * point.normal, from, way) < surely ? far : near) = middle;
        }
        point.excess = std::min(point.excess, far);
      }
    }
}

SurfaceVerdict SurfacePoints::judge(const VoxelSet& standing) const {
  SurfaceVerdict verdict;
  verdict.gouged_points = gouged_;
  verdict.gouge_m = deepest_ / 1000;
  const double coarse = 1000 * grid_.voxel_m / 4;
  verdict.excess_m.resize(points_.size());
  for (const Point& point : points_) {
    double excess = point.excess;
    if (excess == uncut)
      for (excess = gouge_mm; contains(standing, grid_, point.at + excess * point.normal);)
        excess += std::min(coarse, 0.01 + excess / 4);
    verdict.excess_m[point.number] = excess / 1000;
  }
  return verdict;
}

}  // namespace sculpt
