#include "core/verify/mill/near_voxels.hpp"

#include <cmath>
#include <limits>

namespace sculpt {

NearVoxels::NearVoxels(const Grid& grid, const Quanta3& corner, const Quanta3& way, const Vec3& up, double reach)
    : n_(grid.n), size_(std::llround(grid.n * grid.voxel_m * quanta_per_metre)), corner_(corner), reach_(reach) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    origin_[axis] = std::llround(grid.origin_m[static_cast<int>(axis)] * quanta_per_metre);
  const Vec3 go(static_cast<double>(way[0]), static_cast<double>(way[1]), static_cast<double>(way[2]));
  corners_ = {Vec3::Zero(), go, go + up, up};
}

/// All that is near the parallelogram is within this along the axis.
std::array<double, 2> NearVoxels::extent(std::size_t axis) const {
  const auto at = [&](const Vec3& corner) { return corner[static_cast<int>(axis)]; };
  const auto [least, most] = std::ranges::minmax(corners_, {}, at);
  return {at(least) - reach_, at(most) + reach_};
}

/// All that is near the parallelogram and has the other coordinate of this voxel's centre is within this along the
/// axis: as near as that are the points of the parallelogram that are as near along the other axis alone.
std::array<double, 2> NearVoxels::shadow(std::size_t axis, std::size_t other, std::int64_t voxel) const {
  const double at = static_cast<double>(from_corner(other, voxel)), low = at - reach_, high = at + reach_;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t corner = 0; corner < corners_.size(); ++corner) {
    const Vec3 &p = corners_[corner], &q = corners_[(corner + 1) % corners_.size()];
    const double from = p[static_cast<int>(other)], to = q[static_cast<int>(other)];
    if (std::max(from, to) < low || std::min(from, to) > high) continue;
    // The part of the edge that is between the two.
    double begin = 0, end = 1;
    if (from != to) {
      const double s = (low - from) / (to - from), t = (high - from) / (to - from);
      begin = std::clamp(std::min(s, t), 0.0, 1.0);
      end = std::clamp(std::max(s, t), 0.0, 1.0);
    }
    const double first = p[static_cast<int>(axis)], change = q[static_cast<int>(axis)] - first;
    const auto [one, two] = std::minmax({first + begin * change, first + end * change});
    least = std::min(least, one);
    most = std::max(most, two);
  }
  return {least - reach_, most + reach_};
}

/// Of the voxels whose centres are there, and a few more; none where that is nothing.
NearVoxels::Range NearVoxels::numbers(std::size_t axis, const std::array<double, 2>& range) const {
  if (!(range[0] <= range[1])) return {0, -1};
  const auto number = [&](double at) {
    const double voxels = (at + static_cast<double>(corner_[axis] - origin_[axis])) * static_cast<double>(n_) /
                          static_cast<double>(size_);
    return static_cast<std::int64_t>(std::clamp(voxels, -2.0, static_cast<double>(n_) + 2));
  };
  return {std::max<std::int64_t>(0, number(range[0]) - 1), std::min<std::int64_t>(n_ - 1, number(range[1]) + 1)};
}

}  // namespace sculpt
