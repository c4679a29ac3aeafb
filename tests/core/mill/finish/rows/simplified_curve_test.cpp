#include "core/mill/finish/rows/simplified_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sculpt {
namespace {

double away(const Point2& at, const Curve& curve) {
  double least = 1e9;
  for (std::size_t corner = 0; corner + 1 < curve.size(); ++corner) {
    const Point2 way = curve[corner + 1] - curve[corner];
    const double share = std::clamp((at - curve[corner]).dot(way) / way.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (at - curve[corner] - share * way).norm());
  }
  return least;
}

TEST(SimplifiedCurve, StaysNearWhatItWas) {
  Curve circle;
  for (int at = 0; at <= 400; ++at) {
    const double angle = 2 * std::numbers::pi * (at % 400) / 400;
    circle.emplace_back(std::cos(angle), std::sin(angle));
  }
  for (const double off : {1e-3, 1e-2, 1e-1}) {
    const Curve left = simplified(circle, off);
    EXPECT_EQ(left.front(), left.back());
    // A chord is off by its sagitta, so many corners it takes at least.
    EXPECT_GE(static_cast<double>(left.size()), std::numbers::pi / std::acos(1 - off));
    EXPECT_LT(left.size(), 3 * std::numbers::pi / std::acos(1 - off) + 4);
    for (const Point2& at : circle) EXPECT_LE(away(at, left), off + 1e-12);
  }
}

TEST(SimplifiedCurve, OfAStraightOneHasTwoEnds) {
  Curve line;
  for (int at = 0; at < 50; ++at) line.emplace_back(at, 2 * at);
  EXPECT_EQ(simplified(line, 1e-6), (Curve{line.front(), line.back()}));
  EXPECT_EQ(simplified({line.front()}, 1e-6).size(), 1U);
}

}  // namespace
}  // namespace sculpt
