#include "core/program/rounding.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/random.hpp"
#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

double beside_m(const ToolRates& rates, const Configuration& q, const Configuration& rounded) {
  const ToolPose there = rates.chain.tool_pose(q), here = rates.chain.tool_pose(rounded);
  const auto top = [&](const ToolPose& pose) { return Vec3(pose.ball_m + rates.stickout_m * pose.axis); };
  return std::max((there.ball_m - here.ball_m).norm(), (top(there) - top(here)).norm());
}

TEST(Rounding, OtherNumbersHaveTheToolNearerThanTheNearestOnes) {
  Cell cell = shipped_cell("six-axis-turntable");
  cell.programs.couple = {{"A3", "A2"}};
  const Chain chain = cell.chain();
  const ToolRates rates(chain);
  const AxisLayout layout = lay_out_axes(cell, chain, Dialect::fanuc);
  double nearest_sum = 0, sum = 0, nearest_most = 0, most = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Configuration q = random_configuration(chain, random, 0.1), exact = layout.to_axes(q);
    const int decimals = 3;
    const Configuration nearest = nearest_axes(layout, exact, decimals),
                        rounded = round_axes(layout, rates, q, decimals);
    for (Eigen::Index axis = 0; axis < exact.size(); ++axis) {
      const double steps = rounded[axis] * 180 / std::numbers::pi * 1000;
      ASSERT_NEAR(steps, std::round(steps), 1e-6);
      ASSERT_LE(std::abs(nearest[axis] - exact[axis]), 0.5001e-3 * std::numbers::pi / 180);
      ASSERT_LE(std::abs(rounded[axis] - exact[axis]), 1.5001e-3 * std::numbers::pi / 180);
    }
    const double before = beside_m(rates, q, layout.to_joints(nearest)),
                 after = beside_m(rates, q, layout.to_joints(rounded));
    ASSERT_LE(after, before + 1e-9);
    nearest_sum += before;
    sum += after;
    nearest_most = std::max(nearest_most, before);
    most = std::max(most, after);
  }
  EXPECT_LT(sum, 0.6 * nearest_sum) << "of the nearest: " << sum / nearest_sum;
  EXPECT_LT(most, 0.8 * nearest_most) << "of the nearest: " << most / nearest_most;
}

}  // namespace
}  // namespace sculpt
