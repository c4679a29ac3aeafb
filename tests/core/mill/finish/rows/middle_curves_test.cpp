#include "core/mill/finish/rows/middle_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/mill/finish/rows/level_square.hpp"

namespace sculpt {
namespace {

constexpr double edge = LevelSquare::edge, spacing = 1e-3;
constexpr PatchTask patch{spacing / 4, 0.8 * spacing, 3 * spacing, 0.15};

std::vector<Curve> lines(const LevelSquare& level, const std::vector<RestingBall>& balls,
                         const std::vector<Point2>& exact = {}) {
  return middle_curves(make_patch(patch, level.frame, level.nails, balls), exact, spacing);
}

/// Those that a row one spacing wide would leave: at ends a few.
double far_from(const std::vector<Curve>& curves, const std::vector<RestingBall>& balls) {
  double count = 0;
  for (const RestingBall& ball : balls) count += away_from(curves, ball.middle.head<2>()) > 0.75 * spacing;
  return count;
}

TEST(MiddleCurves, GoAlongAStripOnce) {
  const LevelSquare level;
  // A wave across the square, most of a spacing wide.
  const auto balls = level.balls(
      [](const Vec3& at) { return std::abs(at.y() - edge / 2 - 4e-3 * std::sin(at.x() * 300)) < 0.4 * spacing; });
  ASSERT_GT(balls.size(), 60U);
  const std::vector<Curve> curves = lines(level, balls);
  EXPECT_LT(far_from(curves, balls), 0.05 * static_cast<double>(balls.size()));
  EXPECT_LT(length_of(curves), 1.7 * edge);
}

TEST(MiddleCurves, ComeNearAllOfACross) {
  const LevelSquare level;
  const auto balls = level.balls([](const Vec3& at) {
    return std::min(std::abs(at.x() - edge / 2), std::abs(at.y() - edge / 2)) < 0.4 * spacing;
  });
  const std::vector<Curve> curves = lines(level, balls);
  EXPECT_LT(far_from(curves, balls), 0.05 * static_cast<double>(balls.size()));
  EXPECT_LT(length_of(curves), 2.2 * edge);
}

TEST(MiddleCurves, GoThroughExactPlaces) {
  const LevelSquare level;
  const auto balls = level.balls([](const Vec3& at) { return std::abs(at.y() - edge / 2) < 0.4 * spacing; });
  // Beside the middle, all in a line.
  std::vector<Point2> exact;
  for (double x = 2e-3; x < edge - 2e-3; x += 0.5 * spacing)
    exact.emplace_back(level.frame.of(Vec3(x, edge / 2 + 0.2 * spacing, 0)).head<2>());
  const std::vector<Curve> curves = lines(level, balls, exact);
  for (const Point2& at : exact) EXPECT_LT(away_from(curves, at), 0.05 * spacing);
}

TEST(MiddleCurves, GoToWhatStandsAlone) {
  const LevelSquare level;
  auto balls = level.balls([](const Vec3&) { return true; });
  balls.resize(1);
  const std::vector<Curve> curves = lines(level, balls);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_LT(away_from(curves, balls.front().middle.head<2>()), 0.5 * spacing);
  EXPECT_LT(length_of(curves), spacing);
  EXPECT_TRUE(lines(level, {}).empty());
}

}  // namespace
}  // namespace sculpt
