// A slot of 8 mm, 60 mm deep: twice as deep as the flutes of a cutter of 6 mm are long, so its neck goes in too.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/mill/milled_plan.hpp"
#include "tests/core/mill/solids.hpp"

namespace sculpt {
namespace {

using milled::Milled;
using milled::Moved;

constexpr double side_mm = 66, left_mm = 28.3, right_mm = left_mm + 8, front_mm = 20, back_mm = 44, floor_mm = 6,
                 tolerance_mm = 0.3, radius_mm = 3;

double height(double x, double y) {
  return x > left_mm && x < right_mm && y > front_mm && y < back_mm ? floor_mm : side_mm;
}

/// Of what stands above a wall, away from the corners: those vertices that are so high.
std::vector<double> on_wall(const Milled& milled, double x, double from_mm, double to_mm) {
  return milled::excess_at(milled, [&](const Moved& at) {
    const double off = x < (left_mm + right_mm) / 2 ? at.x - at.excess - x : at.x + at.excess - x;
    return std::abs(off) < 0.01 && at.y > front_mm + radius_mm + 1 && at.y < back_mm - radius_mm - 1 &&
           at.z > from_mm && at.z < to_mm;
  });
}

TEST(Slot, ACutterGoesInWithItsNeckAndFinishesTheWalls) {
  Job job = milled::make_job_of(
      milled::height_field(milled::lines_with_steps(side_mm, {left_mm, right_mm, front_mm, back_mm}), height), 256,
      {"D6"}, side_mm / 1000);
  milled::change_tool(job, "D6", R"({"body": [{"length_m": 0.065, "radius_m": 0.002},
    {"length_m": 0.03, "radius_m": 0.012}, {"length_m": 0.07, "radius_m": 0.02}], "stickout_m": 0.195})");
  job.mill->tolerance_m = tolerance_mm / 1000;
  const Milled milled = milled::mill(std::move(job));
  EXPECT_TRUE(milled.result.report.verify.clean);
  EXPECT_EQ(milled.result.report.surface->gouged_points, 0u);
  for (const double wall : {left_mm, right_mm}) {
    const double flute_mm = 30;
    const auto high = on_wall(milled, wall, side_mm - flute_mm, side_mm - 1),
               low = on_wall(milled, wall, floor_mm + radius_mm, side_mm - flute_mm);
    ASSERT_GT(high.size(), 100u);
    ASSERT_GT(low.size(), 100u);
    EXPECT_GT(milled::share_within(high, tolerance_mm), 0.98);
    EXPECT_GT(milled::share_within(low, tolerance_mm), 0.9);
  }
}

}  // namespace
}  // namespace sculpt
