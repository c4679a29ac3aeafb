#include "core/collision/shape/distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

Vec3 random_point(Random& random, double size) {
  return {random.between(-size, size), random.between(-size, size), random.between(-size, size)};
}

/// Smallest distance over a fine grid of parameters: never below the true one, and above it by at most a step.
double sampled_distance(const Segment& a, const Segment& b, int steps) {
  double best = std::numeric_limits<double>::max();
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const double s = static_cast<double>(i) / steps, t = static_cast<double>(j) / steps;
      best = std::min(best, (a.a + s * (a.b - a.a) - b.a - t * (b.b - b.a)).norm());
    }
  return best;
}

double sampled_distance_to_box(const Segment& a, const Vec3& low, const Vec3& high, int steps) {
  double best = std::numeric_limits<double>::max();
  for (int i = 0; i <= steps; ++i) {
    const Vec3 p = a.a + static_cast<double>(i) / steps * (a.b - a.a);
    best = std::min(best, (p - p.cwiseMax(low).cwiseMin(high)).norm());
  }
  return best;
}

TEST(Distance, BetweenSegmentsAgreesWithDenseSampling) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Segment a{random_point(random, 1), random_point(random, 1)},
        b{random_point(random, 1), random_point(random, 1)};
    const double sampled = sampled_distance(a, b, 200), exact = distance(a, b);
    EXPECT_LE(exact, sampled + 1e-12);
    EXPECT_GE(exact, sampled - 0.02);
  }
}

TEST(Distance, BetweenParallelTouchingAndPointSegmentsIsExact) {
  EXPECT_DOUBLE_EQ(distance({{0, 0, 0}, {1, 0, 0}}, {{0, 2, 0}, {1, 2, 0}}), 2);
  EXPECT_DOUBLE_EQ(distance({{0, 0, 0}, {1, 0, 0}}, {{3, 0, 0}, {4, 0, 0}}), 2);
  EXPECT_NEAR(distance({{0, 0, 0}, {1, 1, 0}}, {{1, 0, 0}, {0, 1, 0}}), 0, 1e-15);
  EXPECT_DOUBLE_EQ(distance({{0, 0, 3}, {0, 0, 3}}, {{-1, 0, 0}, {1, 0, 0}}), 3);
  EXPECT_DOUBLE_EQ(distance({{0, 0, 3}, {0, 0, 3}}, {{0, 4, 0}, {0, 4, 0}}), 5);
}

TEST(Distance, ToABoxAgreesWithDenseSampling) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Segment a{random_point(random, 3), random_point(random, 3)};
    const Vec3 low = random_point(random, 1), high = low + random_point(random, 1).cwiseAbs();
    const double sampled = sampled_distance_to_box(a, low, high, 2000), exact = distance_to_box(a, low, high);
    EXPECT_LE(exact, sampled + 1e-12);
    EXPECT_GE(exact, sampled - 0.01);
  }
}

TEST(Distance, ToABoxIsZeroThroughItAndExactAlongAFace) {
  EXPECT_EQ(distance_to_box({{-1, 0.5, 0.5}, {2, 0.5, 0.5}}, {0, 0, 0}, {1, 1, 1}), 0);
  EXPECT_DOUBLE_EQ(distance_to_box({{-1, 0.5, 1.25}, {2, 0.5, 1.25}}, {0, 0, 0}, {1, 1, 1}), 0.25);
  EXPECT_DOUBLE_EQ(distance_to_box({{2, 2, 1}, {2, 2, 1}}, {0, 0, 0}, {1, 1, 1}), std::sqrt(2));
}

}  // namespace
}  // namespace sculpt
