#include "core/mill/finish/rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

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

TEST(Rows, HaveStopsWhereBallsRestBesideAWall) {
  const PartInGrid steps = make_steps();
  const Nails nails(steps.mesh, steps.voxels, steps.grid, 4000, 3);
  const ToolFrame frame({0, 0, 1});
  std::vector<RestingBall> balls;
  for (std::uint32_t nail = 0; nail < nails.size(); ++nail)
    balls.push_back({nail, frame.of(nails[nail].point + radius * nails[nail].normal)});
  std::size_t stops = 0, beside = 0;
  for (const Row& row : find_rows({spacing, 0, radius, nails.area_m2(), 0.4}, frame, nails, balls)) {
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

/// A level square, and balls on those of its nails that are meant.
struct Level {
  PartInGrid square =
      in_grid(quads({{Vec3(0, 0, 0.016), Vec3(edge, 0, 0.016), Vec3(edge, edge, 0.016), Vec3(0, edge, 0.016)}}), edge,
              [](const Voxel& voxel) { return voxel.k < 16; });
  Nails nails{square.mesh, square.voxels, square.grid, 4000, 3};
  ToolFrame frame{{0, 0, 1}};

  std::vector<RestingBall> balls(const std::function<bool(const Vec3&)>& is_meant) const {
    std::vector<RestingBall> found;
    for (std::uint32_t nail = 0; nail < nails.size(); ++nail)
      if (is_meant(nails[nail].point))
        found.push_back({nail, frame.of(nails[nail].point + radius * nails[nail].normal)});
    return found;
  }
  std::vector<Row> rows(const std::vector<RestingBall>& of) const {
    return find_rows({spacing, 0, radius, nails.area_m2(), 0.4}, frame, nails, of);
  }
};

double away(const Point2& at, const Row& row) {
  const Point2 way = row.to - row.from;
  return (at - row.from - std::clamp((at - row.from).dot(way) / way.squaredNorm(), 0.0, 1.0) * way).norm();
}

TEST(Rows, OverALevelSurfaceAreSideBySideFromEdgeToEdge) {
  const Level level;
  const auto balls = level.balls([](const Vec3&) { return true; });
  // At the edge a row may be for half of its width only.
  const auto is_inside = [](const Vec3& at) {
    return std::min(at.x(), at.y()) > spacing / 2 && std::max(at.x(), at.y()) < edge - spacing / 2;
  };
  const std::vector<Row> rows = level.rows(balls);
  EXPECT_NEAR(static_cast<double>(rows.size()), edge / spacing, 1.5);
  const Point2 way = (rows.front().to - rows.front().from).normalized();
  for (const Row& row : rows) {
    EXPECT_NEAR((row.to - row.from).normalized().dot(way), 1, 1e-9);
    EXPECT_GT((row.to - row.from).norm(), 0.9 * edge);
  }
  for (const RestingBall& ball : balls) {
    double nearest = 1;
    for (const Row& row : rows) nearest = std::min(nearest, away(ball.middle.head<2>(), row));
    EXPECT_TRUE(nearest <= spacing / 2 + 1e-9 || !is_inside(level.nails[ball.nail].point)) << nearest;
  }
}

TEST(Rows, ComeByEveryBallOfAPatchAndLeaveOutThoseThatStandAlone) {
  const Level level;
  // A patch, and a few balls here and there.
  const auto in_patch = [](const Vec3& at) { return at.x() < edge / 2 && at.y() < edge / 2; };
  int number = 0;
  const auto balls = level.balls([&](const Vec3& at) { return in_patch(at) || ++number % 150 == 0; });
  const std::vector<Row> rows = level.rows(balls);
  std::size_t alone = 0;
  for (const RestingBall& ball : balls) {
    double nearest = 1;
    for (const Row& row : rows) nearest = std::min(nearest, away(ball.middle.head<2>(), row));
    const Vec3& at = level.nails[ball.nail].point;
    if (in_patch(at + Vec3(spacing, spacing, 0)) && std::min(at.x(), at.y()) > spacing / 2) {
      EXPECT_LE(nearest, spacing / 2 + 1e-9);
    } else {
      alone += !in_patch(at) && nearest > spacing / 2;
    }
  }
  EXPECT_GT(alone, 10U);
}

}  // namespace
}  // namespace sculpt
