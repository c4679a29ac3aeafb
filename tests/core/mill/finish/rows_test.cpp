#include "core/mill/finish/rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sculpt {
namespace {

constexpr double edge = 0.032, wall_x = 0.016, radius = 3e-3, spacing = 1e-3;

/// Two steps with an upright wall between them, low where x is larger.
struct Steps {
  Steps() : voxels{VoxelSet(32, true), VoxelSet(32)} {
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), {a, b, c, d});
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    };
    const double high = 0.024, low = 0.008;
    add({0, 0, high}, {wall_x, 0, high}, {wall_x, edge, high}, {0, edge, high});
    add({wall_x, 0, high}, {wall_x, 0, low}, {wall_x, edge, low}, {wall_x, edge, high});
    add({wall_x, 0, low}, {edge, 0, low}, {edge, edge, low}, {wall_x, edge, low});
    for (int k = 0; k < 24; ++k)
      for (int j = 0; j < 32; ++j)
        for (int i = 0; i < (k < 8 ? 32 : 16); ++i) voxels.keep.insert({i, j, k});
    grid.n = 32;
    grid.voxel_m = edge / 32;
    grid.origin_m = Vec3::Zero();
  }
  Mesh mesh;
  VoxelGrid voxels;
  Grid grid;
};

TEST(Rows, HaveStopsWhereBallsRestBesideAWall) {
  const Steps steps;
  const Nails nails(steps.mesh, steps.voxels, steps.grid, 4000, 3);
  const ToolFrame frame({0, 0, 1});
  std::vector<RestingBall> balls;
  for (std::uint32_t nail = 0; nail < nails.size(); ++nail)
    balls.push_back({nail, frame.of(nails[nail].point + radius * nails[nail].normal)});
  std::size_t stops = 0, beside = 0;
  for (const Row& row : find_rows({spacing, 0, radius}, frame, nails, balls)) {
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
