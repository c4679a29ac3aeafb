// What is deep: how far a tool comes down is decided by its holder, and the figures are those of geometry.
//
//   from the side, 90 mm high:
//
//   +------+ +-----+        +-----\         /-+
//   |      | |     |        |      \       /  |   slot: 8 mm wide, 60 mm deep; well: 26 mm wide, 55 mm deep;
//   | slot | |     |  well  |       \ cone/   |   cone: 55 mm deep, flanks at 15 degrees to the axis
//   |      | |     +--------+        +---+    |
//   |      +-+                                |
//   +-----------------------------------------+
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/core/mill/milled_plan.hpp"
#include "tests/core/mill/solids.hpp"

namespace sculpt {
namespace {

using milled::excess_at;
using milled::Milled;
using milled::Moved;

/// Between sides of voxels, for a neck keeps off voxels that are not gone as a whole (slot_test: the neck in a slot).
constexpr double side_mm = 90, voxel_mm = side_mm / 64, slot_x = 12 * voxel_mm, slot_width_mm = 6 * voxel_mm,
                 slot_mm = 60, well_x = 36, well_y = 24, well_radius_mm = 13, well_mm = 55, cone_x = 60, cone_y = 62,
                 cone_floor_mm = 4, cone_mm = 55, tolerance_mm = 0.3;
const double cone_slope = std::tan(std::numbers::pi / 12);
/// Of the short D12: from its tip to its holder, which is wider than the well.
constexpr double free_mm = 40, holder_radius_mm = 18;

double height(double x, double y) {
  if (std::abs(x - slot_x) < slot_width_mm / 2 && y > 10 && y < 80) return side_mm - slot_mm;
  if (std::hypot(x - well_x, y - well_y) < well_radius_mm) return side_mm - well_mm;
  const double off = std::hypot(x - cone_x, y - cone_y);
  return std::min(side_mm, side_mm - cone_mm + std::max(0.0, off - cone_floor_mm) / cone_slope);
}

Milled mill(const std::vector<std::string>& tools, const std::string& d3 = "{}") {
  Job job = milled::make_job_of(
      milled::height_field(milled::lines_with_steps(side_mm, {slot_x - slot_width_mm / 2, slot_x + slot_width_mm / 2}),
                           height),
      64, tools, side_mm / 1000);
  milled::change_tool(job, "D12", R"({"cutter": {"flute_m": 0.03}, "body": [
    {"length_m": 0.01, "radius_m": 0.006}, {"length_m": 0.1, "radius_m": 0.018}], "stickout_m": 0.14})");
  milled::change_tool(job, "D6", R"({"body": [{"length_m": 0.05, "radius_m": 0.002},
    {"length_m": 0.03, "radius_m": 0.012}, {"length_m": 0.07, "radius_m": 0.02}]})");
  milled::change_tool(job, "D3", d3);
  job.mill->tolerance_m = tolerance_mm / 1000;
  return milled::mill(std::move(job));
}

std::vector<double> on_floor(const Milled& milled, double x, double y, double far, double floor_mm) {
  return excess_at(milled, [&](const Moved& at) {
    return std::hypot(at.x - x, at.y - y) < far && std::abs(at.z - at.excess - floor_mm) < 0.01;
  });
}

/// Some cutter of this size would reach what was left, were it as long as that.
bool is_cured_by(const Milled& milled, double diameter_mm, double least_mm, double most_mm) {
  return std::ranges::any_of(milled.result.report.cures, [&](const Cure& cure) {
    return cure.obstacle == Obstacle::length && std::abs(1000 * cure.diameter_m - diameter_mm) < 0.01 &&
           1000 * cure.free_m >= least_mm && 1000 * cure.free_m <= most_mm;
  });
}

void expect_between(const std::vector<double>& excess_mm, double least, double most) {
  ASSERT_FALSE(excess_mm.empty());
  EXPECT_GT(excess_mm.front(), least - 0.01);
  EXPECT_LT(excess_mm.back(), most);
}

TEST(Deep, TheHolderDecidesHowDeep) {
  const Milled milled = mill({"D12"});
  EXPECT_TRUE(milled.result.report.verify.clean);
  EXPECT_EQ(milled.result.report.surface->gouged_points, 0u);
  // A level is left that comes down less than a depth of cut, and cusps on the one above it.
  const double depth_mm = 6, cusp_mm = 0.35 * depth_mm;
  const double over_well = well_mm - free_mm;
  expect_between(on_floor(milled, well_x, well_y, 4, side_mm - well_mm), over_well, over_well + depth_mm + cusp_mm);
  const double over_cone = (holder_radius_mm - cone_floor_mm) / cone_slope - free_mm;
  expect_between(on_floor(milled, cone_x, cone_y, 2, side_mm - cone_mm), over_cone, over_cone + depth_mm + cusp_mm);
  EXPECT_TRUE(is_cured_by(milled, 12, 55, 56));
}

TEST(Deep, AThinnerToolComesToTheFloorAndIntoTheSlotWithItsFlutes) {
  const Milled milled = mill({"D12", "D6"});
  EXPECT_TRUE(milled.result.report.verify.clean);
  EXPECT_EQ(milled.result.report.surface->gouged_points, 0u);
  const auto floor = on_floor(milled, well_x, well_y, 9, side_mm - well_mm);
  ASSERT_GT(floor.size(), 100u);
  EXPECT_GT(milled::share_within(floor, tolerance_mm), 0.8) << floor.back();
  // Its neck keeps off voxels that stand beside the walls: here they are too large for it.
  const double flute_mm = 30, depth_mm = 3;
  expect_between(on_floor(milled, slot_x, 45, 1, side_mm - slot_mm), 0, slot_mm - flute_mm + depth_mm);
}

TEST(Deep, AToolThatIsTooShortForTheSlotMustBeLonger) {
  const Milled milled = mill({"D3"}, R"({"body": [{"length_m": 0.013, "radius_m": 0.00145},
    {"length_m": 0.1, "radius_m": 0.012}], "stickout_m": 0.125})");
  EXPECT_TRUE(milled.result.report.verify.clean);
  EXPECT_TRUE(is_cured_by(milled, 3, slot_mm, slot_mm + 1));
}

}  // namespace
}  // namespace sculpt
