// A plate with the features that milling fails at, each with the figure that geometry gives for it.
//
//   from above, 50 x 50 mm, 12 mm deep features in a plate of 40 mm:
//
//   +--------------------+
//   |  bowl    | groove  |   bowl: half a ball of 10 mm; groove: 120 degrees, along y
//   |  (    )  |  \/     |
//   |----------+---------|
//   | pocket|pocket slot |   pockets with a wall of 2 mm between them; slot: 4 mm wide, thinner than the cutter
//   +--------------------+
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/core/mill/milled_plan.hpp"
#include "tests/core/mill/solids.hpp"

namespace sculpt {
namespace {

using milled::Milled;
using milled::Moved;
using milled::share_within;

constexpr double side_mm = 50, top_mm = 40, cells_a_mm = 2, radius_mm = 3, tolerance_mm = 0.3;
constexpr double bowl_x = 13, bowl_y = 36, bowl_mm = 10, groove_x = 37, groove_depth_mm = 6;
constexpr double pocket_depth_mm = 6, slot_x = 41;

/// How high the plate is (mm).
double height(double x, double y) {
  if (const double off = std::hypot(x - bowl_x, y - bowl_y); off < bowl_mm)
    return top_mm - std::sqrt(bowl_mm * bowl_mm - off * off);
  const double flank = std::tan(std::numbers::pi / 3);
  if (y > 26 && y < 48)
    if (const double off = std::abs(x - groove_x); off < groove_depth_mm * flank)
      return top_mm - groove_depth_mm + off / flank;
  const bool in_pockets = y > 4 && y < 20 && ((x > 3 && x < 15) || (x > 17 && x < 29));
  const bool in_slot = y > 4 && y < 20 && std::abs(x - slot_x) < 2;
  return in_pockets || in_slot ? top_mm - pocket_depth_mm : top_mm;
}

const Milled& plate() {
  static const Milled plate = [] {
    Job job =
        milled::make_job_of(milled::height_field(side_mm, static_cast<int>(side_mm * cells_a_mm), height), 32, {"D6"});
    job.mill->tolerance_m = tolerance_mm / 1000;
    return milled::mill(std::move(job));
  }();
  return plate;
}

/// What stands above those vertices that are meant, at the top of the plate.
std::vector<double> excess_at(const std::function<bool(const Moved&)>& is_meant) {
  return milled::excess_at(plate(), [&](const Moved& at) { return at.z > top_mm / 2 && is_meant(at); });
}

TEST(Plate, IsCleanAndNothingIsCutTooDeep) {
  const Report& report = plate().result.report;
  EXPECT_TRUE(report.verify.clean);
  ASSERT_TRUE(report.surface);
  EXPECT_EQ(report.surface->gouged_points, 0u);
}

TEST(Plate, BowlAndTopAreWithinTheTolerance) {
  const auto bowl = excess_at(
      [](const Moved& at) { return std::hypot(at.x - bowl_x, at.y - bowl_y) < bowl_mm - 1 && at.z < top_mm - 0.5; });
  ASSERT_GT(bowl.size(), 300u);
  EXPECT_GT(share_within(bowl, tolerance_mm), 0.98) << bowl.back();
  const auto top = excess_at([](const Moved& at) {
    return at.z > top_mm - 0.01 && at.z < top_mm + 5 && height(at.x, at.y) == top_mm && at.x > 1 && at.y > 1 &&
           at.x < 49 && at.y < 49;
  });
  ASSERT_GT(top.size(), 1000u);
  EXPECT_GT(share_within(top, tolerance_mm), 0.98) << top.back();
}

/// A ball between two flanks at 60 degrees to the axis leaves r / sin 60 - r above the crease.
TEST(Plate, TheCreaseHasWhatTheBallLeaves) {
  const auto crease = excess_at([](const Moved& at) {
    return std::abs(at.x - groove_x) < 0.01 && at.y > 30 && at.y < 44 && at.z < top_mm - groove_depth_mm + 2;
  });
  ASSERT_GT(crease.size(), 20u);
  const double sine = std::sin(std::numbers::pi / 3), least = radius_mm / sine - radius_mm;
  EXPECT_GT(crease.front(), least - 0.002);
  EXPECT_LT(crease[crease.size() / 2], least + tolerance_mm / sine);
}

TEST(Plate, TheWallBetweenPocketsStands) {
  const auto wall_top = excess_at(
      [](const Moved& at) { return at.x > 15.1 && at.x < 16.9 && at.y > 6 && at.y < 18 && at.z > top_mm - 0.1; });
  ASSERT_GT(wall_top.size(), 20u);
  EXPECT_GT(share_within(wall_top, tolerance_mm), 0.9) << wall_top.back();
  const double floor_mm = top_mm - pocket_depth_mm;
  const auto floors = excess_at([&](const Moved& at) {
    const bool in_middle = at.y > 8 && at.y < 16 && ((at.x > 7 && at.x < 11) || (at.x > 21 && at.x < 25));
    return in_middle && at.z >= floor_mm && at.z < floor_mm + 1.2;
  });
  ASSERT_GT(floors.size(), 50u);
  EXPECT_GT(share_within(floors, tolerance_mm), 0.95) << floors.back();
}

TEST(Plate, TheSlotThatIsTooThinIsLeftAndTheReportNamesTheCutter) {
  const double sunk_mm = radius_mm - std::sqrt(radius_mm * radius_mm - 2 * 2), left_mm = pocket_depth_mm - sunk_mm,
               voxel_mm = side_mm / 32;
  const auto slot = excess_at([&](const Moved& at) {
    const bool from_floor = std::abs(at.z - at.excess - (top_mm - pocket_depth_mm)) < 0.01;
    return from_floor && std::abs(at.x - slot_x) < 0.6 && at.y > 8 && at.y < 16;
  });
  ASSERT_GT(slot.size(), 20u);
  EXPECT_GT(slot.front(), left_mm - 0.002) << "the ball does not go in";
  EXPECT_LT(slot.back(), left_mm + tolerance_mm + voxel_mm) << "but as deep as it can";
  const auto& cures = plate().result.report.cures;
  EXPECT_TRUE(std::ranges::any_of(
      cures, [](const Cure& cure) { return cure.obstacle == Obstacle::radius && cure.diameter_m < 2e-3 * radius_mm; }));
}

}  // namespace
}  // namespace sculpt
