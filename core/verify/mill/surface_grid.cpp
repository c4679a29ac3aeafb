#include "core/verify/mill/surface_grid.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/mill/moving_cutter.hpp"

namespace sculpt {
namespace {

constexpr int boxes_along = 96;
/// A way that climbs more is looked at in parts, but that of a ball.
constexpr double max_rise_mm = 0.25;

Eigen::AlignedBox3d box_around(const std::array<Vec3, 3>& t) {
  return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
}

}  // namespace

SurfaceGrid::SurfaceGrid(const Mesh& part) {
  Eigen::AlignedBox3d all;
  for (const auto& t : part.triangles) {
    triangles_.push_back({1000 * part.vertices[t[0]], 1000 * part.vertices[t[1]], 1000 * part.vertices[t[2]]});
    const Corners& corners = triangles_.back();
    all.extend(box_around(corners));
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
  for (const Corners& t : triangles_) for_each_box(box_around(t), [&](std::size_t box) { ++begin_[box + 1]; });
  for (std::size_t box = 0; box < count; ++box) begin_[box + 1] += begin_[box];
  numbers_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t number = 0; number < triangles_.size(); ++number)
    for_each_box(box_around(triangles_[number]), [&](std::size_t box) { numbers_[next[box]++] = number; });
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

template <typename Visit>
void SurfaceGrid::for_each_box(const Eigen::AlignedBox3d& around, const Visit& visit) const {
  const auto first = box_of(around.min()), last = box_of(around.max());
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i)
        visit(static_cast<std::size_t>(i) +
              static_cast<std::size_t>(boxes_[0]) *
                  (static_cast<std::size_t>(j) + static_cast<std::size_t>(boxes_[1]) * static_cast<std::size_t>(k)));
}

const std::vector<std::uint32_t>& SurfaceGrid::within(const Eigen::AlignedBox3d& around) {
  found_.clear();
  ++search_;
  for_each_box(around, [&](std::size_t box) {
    for (std::uint32_t at = begin_[box]; at < begin_[box + 1]; ++at) {
      const std::uint32_t number = numbers_[at];
      if (seen_[number] == search_) continue;
      seen_[number] = search_;
      if (around.intersects(box_around(triangles_[number]))) found_.push_back(number);
    }
  });
  return found_;
}

double SurfaceGrid::depth(const Cutter& cutter, const Vec3& axis, const Vec3& from, const Vec3& to, double enough_mm) {
  double deepest = -enough_mm;
  if (triangles_.empty()) return deepest;
  const double rise = std::abs((to - from).dot(axis));
  const int parts = cutter.kind == CutterKind::ball ? 1 : std::max(1, static_cast<int>(std::ceil(rise / max_rise_mm)));
  for (int part = 0; part < parts; ++part) {
    const MovingCutter moving(cutter, axis, from + (to - from) * part / parts, from + (to - from) * (part + 1) / parts);
    for (const std::uint32_t number : within(moving.box(enough_mm)))
      if (moving.is_near(balls_[number].middle, balls_[number].radius, -deepest))
        deepest = std::max(deepest, moving.depth(triangles_[number]));
  }
  return deepest;
}

}  // namespace sculpt
