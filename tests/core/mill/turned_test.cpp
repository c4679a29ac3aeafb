// Turned parts: what only a tool from below comes to, a ball on a thin stem, and the inside of a cup.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/core/mill/milled_plan.hpp"
#include "tests/core/mill/solids.hpp"

namespace sculpt {
namespace {

using milled::excess_at;
using milled::Milled;
using milled::Moved;

constexpr double middle_mm = 25, tolerance_mm = 0.3;

Milled mill(const std::string& stl, const std::vector<std::string>& tools) {
  Job job = milled::make_job_of(stl, 32, tools);
  // A post that is thinner than the stock: tools come from below.
  auto cell = nlohmann::json::parse(job.cell.cell_json);
  cell["stock"]["post"]["width_m"] = 0.02;
  job.cell.cell_json = cell.dump();
  job.mill->tolerance_m = tolerance_mm / 1000;
  return milled::mill(std::move(job));
}

double radius_of(const Moved& at) {
  return std::hypot(at.x - middle_mm, at.y - middle_mm);
}

/// The underside of its cap rises inwards at 20 degrees: no level tool comes there, its rim is lower.
TEST(Turned, TheUndersideOfAMushroomIsMilledFromBelow) {
  const double stem_mm = 5, cap_mm = 18, rim_mm = 26, rise_mm = (cap_mm - stem_mm) * std::tan(std::numbers::pi / 9);
  const Milled milled =
      mill(milled::turned({{0, 0}, {stem_mm, 0}, {stem_mm, rim_mm + rise_mm}, {cap_mm, rim_mm}, {cap_mm, 38}, {0, 38}}),
           {"D12", "D6"});
  EXPECT_TRUE(milled.result.report.verify.clean);
  EXPECT_EQ(milled.result.report.surface->gouged_points, 0u);
  const auto under = excess_at(milled, [&](const Moved& at) {
    const double r = radius_of(at);
    return r > stem_mm + 4 && r < cap_mm - 1 && at.z < rim_mm + rise_mm && at.z > 5;
  });
  ASSERT_GT(under.size(), 100u);
  EXPECT_GT(milled::share_within(under, tolerance_mm), 0.98) << under.back();
}

TEST(Turned, ABallOnAThinStemStands) {
  std::vector<std::array<double, 2>> outline{{0, 0}, {12, 0}, {12, 6}, {2, 6}};
  const double ball_mm = 12, centre_mm = 33;
  for (int step = -80; step <= 90; step += 5) {
    const double angle = step * std::numbers::pi / 180, r = ball_mm * std::cos(angle);
    if (r > 2 || step > 0) outline.push_back({step == 90 ? 0 : r, centre_mm + ball_mm * std::sin(angle)});
  }
  const Milled milled = mill(milled::turned(outline), {"D12", "D6"});
  EXPECT_TRUE(milled.result.report.verify.clean);
  EXPECT_EQ(milled.result.report.surface->gouged_points, 0u);
  EXPECT_EQ(milled.result.report.voxels.freed, 0u);
  const auto ball = excess_at(milled, [&](const Moved& at) { return at.z > centre_mm; });
  ASSERT_GT(ball.size(), 100u);
  EXPECT_GT(milled::share_within(ball, tolerance_mm), 0.99) << ball.back();
}

TEST(Turned, ACupIsMilledInside) {
  const Milled milled = mill(milled::turned({{0, 0}, {14, 0}, {20, 40}, {17, 40}, {11, 12}, {0, 12}}), {"D12", "D6"});
  EXPECT_TRUE(milled.result.report.verify.clean);
  EXPECT_EQ(milled.result.report.surface->gouged_points, 0u);
  const auto floor = excess_at(milled, [&](const Moved& at) { return radius_of(at) < 7 && at.z > 11.9 && at.z < 39; });
  const auto wall = excess_at(milled, [&](const Moved& at) {
    const double r = radius_of(at);
    return at.z > 16 && at.z < 38 && r < 11 + (at.z - 12) * 6 / 28 + 0.01 && r > 2;
  });
  ASSERT_GT(floor.size(), 20u);
  ASSERT_GT(wall.size(), 100u);
  EXPECT_GT(milled::share_within(floor, tolerance_mm), 0.98) << floor.back();
  EXPECT_GT(milled::share_within(wall, tolerance_mm), 0.98) << wall.back();
}

}  // namespace
}  // namespace sculpt
