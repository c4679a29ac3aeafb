#include "core/mill/finish/rows/parallel_curves.hpp"

#include <gtest/gtest.h>

#include "tests/core/mill/finish/rows/level_square.hpp"

namespace sculpt {
namespace {

constexpr double edge = LevelSquare::edge, spacing = 1e-3, reach = 0.75 * spacing;

std::vector<Curve> rows(const LevelSquare& level, const std::vector<RestingBall>& balls, bool along_u) {
  return parallel_curves(make_patch({spacing / 4, reach, 3 * spacing, 0.35}, level.frame, level.nails, balls), reach,
                         spacing, along_u);
}

TEST(ParallelCurves, ComeByAllOfASquare) {
  const LevelSquare level;
  const auto balls = level.balls([](const Vec3&) { return true; });
  for (const bool along_u : {true, false}) {
    const std::vector<Curve> curves = rows(level, balls, along_u);
    // Here and there a nail is so far from the others that a row is broken.
    EXPECT_NEAR(length_of(curves), edge * edge / spacing, 0.06 * edge * edge / spacing);
    for (const Curve& curve : curves) {
      const Point2 way = curve.back() - curve.front();
      EXPECT_LT(std::abs(way[along_u ? 1 : 0]), 0.1 * spacing);
    }
    for (const RestingBall& ball : balls) EXPECT_LT(away_from(curves, ball.middle.head<2>()), 0.75 * spacing);
  }
}

TEST(ParallelCurves, LieAsFarApartAlongASlope) {
  LevelSquare level;
  level.frame = ToolFrame({1, 0, 1});
  const auto balls = level.balls([](const Vec3&) { return true; });
  const Vec3 normal = level.frame.of(Vec3::UnitZ());
  for (const bool along_u : {true, false}) {
    double length = 0;
    for (const Curve& curve : rows(level, balls, along_u))
      for (std::size_t at = 0; at + 1 < curve.size(); ++at) {
        const Point2 way = curve[at + 1] - curve[at];
        length += Vec3(way.x(), way.y(), -way.dot(normal.head<2>()) / normal.z()).norm();
      }
    EXPECT_NEAR(length, edge * edge / spacing, 0.08 * edge * edge / spacing);
  }
}

TEST(ParallelCurves, AreBrokenWhereNothingIsAsked) {
  const LevelSquare level;
  const auto balls = level.balls([](const Vec3& at) { return std::abs(at.x() - edge / 2) > 4 * spacing; });
  for (const bool along_u : {true, false})
    for (const Curve& curve : rows(level, balls, along_u))
      for (const Point2& at : curve)
        EXPECT_GT(std::abs(level.frame.point({at.x(), at.y(), 0}).x() - edge / 2), 4 * spacing - 1.1 * reach);
  EXPECT_TRUE(rows(level, {}, true).empty());
}

}  // namespace
}  // namespace sculpt
