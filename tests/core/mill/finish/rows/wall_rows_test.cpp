#include "core/mill/finish/rows/wall_rows.hpp"

#include <gtest/gtest.h>

#include "tests/core/mill/finish/quads.hpp"

namespace sculpt {
namespace {

constexpr double edge = 0.032, wall_x = 0.016, radius = 3e-3, spacing = 1e-3;

/// Two steps with an upright wall between them, low where x is larger.
PartInGrid make_steps() {
  const double high = 0.024, low = 0.008;
  return in_grid(
      quads({{Vec3(0, 0, high), Vec3(wall_x, 0, high), Vec3(wall_x, edge, high), Vec3(0, edge, high)},
             {Vec3(wall_x, 0, high), Vec3(wall_x, 0, low), Vec3(wall_x, edge, low), Vec3(wall_x, edge, high)},
             {Vec3(wall_x, 0, low), Vec3(edge, 0, low), Vec3(edge, edge, low), Vec3(wall_x, edge, low)}}),
      edge, [](const Voxel& voxel) { return voxel.k < 8 || (voxel.k < 24 && voxel.i < 16); });
}

TEST(WallRows, HaveStopsWhereBallsRestBesideAWall) {
  const PartInGrid steps = make_steps();
  const Nails nails(steps.mesh, steps.voxels, steps.grid, 4000, 3);
  const ToolFrame frame({0, 0, 1});
  std::vector<RestingBall> balls;
  for (std::uint32_t nail = 0; nail < nails.size(); ++nail)
    balls.push_back({nail, frame.of(nails[nail].point + radius * nails[nail].normal), false});
  std::size_t stops = 0, beside = 0;
  for (const Row& row : wall_rows({spacing, 0, radius, nails.area_m2()}, frame, nails, balls)) {
    double before = -1;
    for (const WallStop& stop : row.stops) {
      EXPECT_GE(stop.along_m, before);
      before = stop.along_m;
      const Point2 at = row.from + stop.along_m * (row.to - row.from).normalized();
      EXPECT_NEAR(frame.point({at.x(), at.y(), 0}).x(), wall_x + radius, 1e-9);
      EXPECT_GT(stop.height_m, 0.008 - radius - 1e-9);
      EXPECT_LT(stop.height_m, 0.024 - radius + 1e-9);
      ++stops;
    }
  }
  for (std::uint32_t nail = 0; nail < nails.size(); ++nail) beside += nails[nail].normal.x() > 0.5;
  EXPECT_GT(beside, 100U);
  EXPECT_EQ(stops, beside);
}

}  // namespace
}  // namespace sculpt
