// Round things, and a tool that is shorter than the one before it.
//
//   from the side, 50 mm wide:
//
//          .-------.        dome: of a sphere of 80 mm; dimple: of a sphere of 5 mm, 4 mm deep
//       .-'    _    '-.     groove: as wide as the cutter
//      |     \_/       |
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/mill/milled_plan.hpp"
#include "tests/core/mill/solids.hpp"

namespace sculpt {
namespace {

using milled::excess_at;
using milled::Milled;
using milled::Moved;

constexpr double side_mm = 50, middle_mm = 25, top_mm = 40, dome_mm = 80, dimple_mm = 5, dimple_depth_mm = 4,
                 tolerance_mm = 0.2;

double dome(double x, double y) {
  const double off2 = (x - middle_mm) * (x - middle_mm) + (y - middle_mm) * (y - middle_mm);
  return top_mm - dome_mm + std::sqrt(dome_mm * dome_mm - off2);
}

Milled mill(const std::function<double(double, double)>& height, const std::vector<std::string>& tools,
            const std::string& d6 = "{}") {
  Job job = milled::make_job_of(milled::height_field(side_mm, 100, height), 32, tools);
  milled::change_tool(job, "D6", d6);
  job.mill->tolerance_m = tolerance_mm / 1000;
  return milled::mill(std::move(job));
}

/// A plate with a dimple in its middle.
double dimpled(double x, double y) {
  const double off2 = (x - middle_mm) * (x - middle_mm) + (y - middle_mm) * (y - middle_mm);
  if (off2 > dimple_mm * dimple_mm) return top_mm;
  return std::min(top_mm, top_mm + dimple_mm - dimple_depth_mm - std::sqrt(dimple_mm * dimple_mm - off2));
}

/// What stands above the lowest place of the dimple.
double in_dimple(const Milled& milled) {
  const auto bottom = excess_at(milled, [](const Moved& at) {
    return std::hypot(at.x - middle_mm, at.y - middle_mm) < 0.1 && at.z > top_mm - 5;
  });
  return bottom.empty() ? -1 : bottom.front();
}

TEST(Dome, RowsLeaveTheScallopsThatWereOrdered) {
  const Milled milled = mill(dome, {"D12"});
  EXPECT_TRUE(milled.result.report.verify.clean);
  EXPECT_EQ(milled.result.report.surface->gouged_points, 0u);
  const auto top = excess_at(
      milled, [](const Moved& at) { return std::hypot(at.x - middle_mm, at.y - middle_mm) < 20 && at.z > top_mm - 3; });
  ASSERT_GT(top.size(), 1000u);
  const double scallop_mm = top.back() - top.front(), ordered_mm = 0.35 * tolerance_mm;
  EXPECT_GT(scallop_mm, 0.8 * ordered_mm);
  EXPECT_LT(scallop_mm, 1.1 * ordered_mm);
}

TEST(Dome, ABallThatIsTooLargeForADimpleRestsOnItsRim) {
  const Milled milled = mill(dimpled, {"D12"});
  EXPECT_TRUE(milled.result.report.verify.clean);
  const double rim_mm = std::sqrt(dimple_mm * dimple_mm - std::pow(dimple_mm - dimple_depth_mm, 2)), radius_mm = 6;
  const double left_mm = dimple_depth_mm - (radius_mm - std::sqrt(radius_mm * radius_mm - rim_mm * rim_mm));
  EXPECT_GT(in_dimple(milled), left_mm - 0.01);
  EXPECT_LT(in_dimple(milled), left_mm + tolerance_mm);
}

TEST(Dome, AToolMayBeShorterThanTheOneBefore) {
  const Milled milled = mill(dimpled, {"D12", "D6"}, R"({"cutter": {"flute_m": 0.012}, "body": [
    {"length_m": 0.01, "radius_m": 0.003}, {"length_m": 0.05, "radius_m": 0.012}], "stickout_m": 0.075})");
  EXPECT_TRUE(milled.result.report.verify.clean);
  EXPECT_EQ(milled.result.report.surface->gouged_points, 0u);
  EXPECT_GE(in_dimple(milled), 0);
  EXPECT_LT(in_dimple(milled), tolerance_mm);
}

TEST(Dome, AGrooveAsWideAsTheCutterNeedsAThinnerOne) {
  const auto grooved = [](double x, double y) {
    return std::abs(x - middle_mm) < 3 && y > 10 && y < 40 ? top_mm - 5 : top_mm;
  };
  const Milled milled = mill(grooved, {"D6"});
  EXPECT_TRUE(milled.result.report.verify.clean);
  EXPECT_EQ(milled.result.report.surface->gouged_points, 0u);
  const std::vector<Cure>& cures = milled.result.report.cures;
  ASSERT_FALSE(cures.empty());
  EXPECT_EQ(cures.front().obstacle, Obstacle::radius);
  EXPECT_LT(cures.front().diameter_m, 0.006);
}

}  // namespace
}  // namespace sculpt
