#include "core/verify/mill/near_voxels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/random.hpp"
#include "tests/core/base/cases.hpp"

namespace sculpt {
namespace {

/// Of a point from a segment.
double from_segment(const Vec3& point, const Vec3& from, const Vec3& way) {
  const double length2 = way.squaredNorm();
  const double t = length2 > 0 ? std::clamp((point - from).dot(way) / length2, 0.0, 1.0) : 0;
  return (point - from - t * way).norm();
}

/// Of a point from a parallelogram with one corner at 0: where it projects into it, or from its edges.
double from_parallelogram(const Vec3& point, const Vec3& way, const Vec3& up) {
  double least = std::numeric_limits<double>::infinity();
  const Vec3 normal = way.cross(up);
  if (normal.squaredNorm() > 0) {
    Eigen::Matrix3d frame;
    frame << way, up, normal.normalized();
    const Vec3 parts = frame.inverse() * point;
    if (parts.x() >= 0 && parts.x() <= 1 && parts.y() >= 0 && parts.y() <= 1) least = std::abs(parts.z());
  }
  for (const auto& [from, edge] : {std::pair{Vec3(0, 0, 0), way}, {up, way}, {Vec3(0, 0, 0), up}, {way, up}})
    least = std::min(least, from_segment(point, from, edge));
  return least;
}

TEST(NearVoxels, HoldsAllThatAreNear) {
  constexpr int n = 24;
  const Grid grid{n, 0.004, Vec3(-0.041, -0.05, 0.013)};
  std::size_t visits = 0, near = 0;
  for (int seed = 0; seed < cases(200); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(static_cast<std::uint64_t>(seed));
    // Some along an axis, some of no length, some beside the grid.
    const auto part = [&](double most) { return random.next() % 4 == 0 ? 0.0 : random.between(-most, most); };
    Quanta3 corner{}, way{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = grid.origin_m[static_cast<int>(axis)], size = n * grid.voxel_m;
      corner[axis] = std::llround(quanta_per_metre * random.between(low - 0.2 * size, low + 1.2 * size));
      way[axis] = std::llround(quanta_per_metre * part(0.03));
    }
    const Vec3 up = quanta_per_metre * Vec3(part(0.05), part(0.05), part(0.05));
    const double reach = quanta_per_metre * random.between(1e-4, 0.02);
    const NearVoxels voxels(grid, corner, way, up, reach);
    VoxelSet visited(n);
    voxels.for_each_row([&](std::int64_t first, std::int64_t last, std::int64_t j, std::int64_t k) {
      visits += static_cast<std::size_t>(last - first + 1);
      for (std::int64_t i = first; i <= last; ++i)
        visited.insert({static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)});
    });
    const Vec3 go(static_cast<double>(way[0]), static_cast<double>(way[1]), static_cast<double>(way[2]));
    const Vec3 from(static_cast<double>(corner[0]), static_cast<double>(corner[1]), static_cast<double>(corner[2]));
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const Vec3 centre = quanta_per_metre * grid.centre({i, j, k}) - from;
          if (from_parallelogram(centre, go, up) > reach - 2) continue;
          ++near;
          ASSERT_TRUE(visited.contains({i, j, k})) << i << " " << j << " " << k;
        }
  }
  EXPECT_GT(near, visits / 3) << "few are visited in vain";
}

}  // namespace
}  // namespace sculpt
