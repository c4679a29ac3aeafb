// What is said to be free must be, all of it, and must not depend on what was asked before.
#include "core/verify/free_ranges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

/// Obstacles on a line; a range is free if none is within a quarter more than it.
struct Line {
  std::vector<double> obstacles;
  int asked = 0;

  FreeRanges::IsFree is_free() {
    return [this](double middle, double half) {
      ++asked;
      for (const double at : obstacles)
        if (std::abs(at - middle) <= 1.25 * half) return false;
      return true;
    };
  }
};

TEST(FreeRanges, HoldNoObstacleAndSayTheSameInAnyOrder) {
  int held = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Line line;
    for (int at = 0; at < 5; ++at) line.obstacles.push_back(random.between(-20, 20));
    FreeRanges ranges;
    for (int round = 0; round < 200; ++round) {
      const double low = random.between(-20, 20), high = low + std::pow(10, random.between(-6, 1));
      const bool holds = ranges.hold(low, high, line.is_free());
      for (const double at : line.obstacles)
        if (at >= low && at <= high) {
          EXPECT_FALSE(holds) << low << " " << high << " " << at;
        }
      EXPECT_EQ(holds, FreeRanges().hold(low, high, line.is_free()));
      held += holds;
      refused += !holds;
    }
  }
  EXPECT_GT(held, 5000);
  EXPECT_GT(refused, 500);
}

TEST(FreeRanges, AskOnlyOnce) {
  Line line{{3}};
  FreeRanges ranges;
  EXPECT_TRUE(ranges.hold(-1, 2, line.is_free()));
  EXPECT_FALSE(ranges.hold(2, 4, line.is_free()));
  const int asked = line.asked;
  EXPECT_TRUE(ranges.hold(-1, 2, line.is_free()));
  EXPECT_FALSE(ranges.hold(2, 4, line.is_free()));
  EXPECT_EQ(line.asked, asked);
}

TEST(FreeRanges, OfOnePointAreAskedAbout) {
  Line line{{3}};
  EXPECT_TRUE(FreeRanges().hold(2.5, 2.5, line.is_free()));
  EXPECT_FALSE(FreeRanges().hold(3, 3, line.is_free()));
}

}  // namespace
}  // namespace sculpt
