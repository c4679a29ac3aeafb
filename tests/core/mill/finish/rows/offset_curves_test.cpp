#include "core/mill/finish/rows/offset_curves.hpp"

#include <gtest/gtest.h>

#include "tests/core/mill/finish/rows/level_square.hpp"

namespace sculpt {
namespace {

constexpr double edge = LevelSquare::edge, spacing = 1e-3;
constexpr PatchTask patch{spacing / 4, spacing, 3 * spacing, 0.35};

std::vector<Curve> rings(const LevelSquare& level, const std::vector<RestingBall>& balls) {
  return offset_curves(make_patch(patch, level.frame, level.nails, balls), 1.5 * spacing, spacing, Helpers(2));
}

TEST(OffsetCurves, OverASquareAreClosedAndOneSpacingApart) {
  const LevelSquare level;
  const auto balls = level.balls([](const Vec3&) { return true; });
  const std::vector<Curve> curves = rings(level, balls);
  for (const Curve& curve : curves) EXPECT_LT((curve.front() - curve.back()).norm(), 1e-9);
  // What is longer than area over spacing is waste; corners and the middle are less than all of it.
  EXPECT_LT(length_of(curves), 1.05 * edge * edge / spacing);
  EXPECT_GT(length_of(curves), 0.85 * edge * edge / spacing);
  // A ring is half a spacing inside; in corners and in the middle, where four sides meet, it is farther.
  std::size_t far = 0;
  for (const RestingBall& ball : balls) far += away_from(curves, ball.middle.head<2>()) > 0.6 * spacing;
  EXPECT_LT(static_cast<double>(far), 0.05 * static_cast<double>(balls.size()));
}

TEST(OffsetCurves, GoAroundAHoleAndDoNotGoWhereASurfaceEnds) {
  const LevelSquare level;
  const Vec3 middle(edge / 2, edge / 2, 0.016);
  const double hole = 6e-3;
  const auto balls = level.balls([&](const Vec3& at) { return (at - middle).norm() > hole; });
  for (const Curve& curve : rings(level, balls))
    for (const Point2& at : curve) EXPECT_GT((at - level.frame.of(middle).head<2>()).norm(), hole + 0.2 * spacing);
}

TEST(OffsetCurves, WhatIsNarrowHasNone) {
  const LevelSquare level;
  EXPECT_TRUE(
      rings(level, level.balls([](const Vec3& at) { return std::abs(at.x() - edge / 2) < 0.3 * spacing; })).empty());
  EXPECT_TRUE(rings(level, {}).empty());
}

/// Seen from a slant the same surface takes rings as far apart, along it.
TEST(OffsetCurves, AreAsFarApartOnASlope) {
  LevelSquare level;
  level.frame = ToolFrame({1, 0, 1});
  const auto balls = level.balls([](const Vec3&) { return true; });
  double length = 0;
  const Vec3 normal = level.frame.of(Vec3::UnitZ());
  for (const Curve& curve : rings(level, balls))
    for (std::size_t at = 0; at + 1 < curve.size(); ++at) {
      const Point2 way = curve[at + 1] - curve[at];
      length += Vec3(way.x(), way.y(), -way.dot(normal.head<2>()) / normal.z()).norm();
    }
  EXPECT_NEAR(length, 0.95 * edge * edge / spacing, 0.08 * edge * edge / spacing);
}

}  // namespace
}  // namespace sculpt
