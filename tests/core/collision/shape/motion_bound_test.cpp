#include "core/collision/shape/motion_bound.hpp"

#include <gtest/gtest.h>

#include "tests/core/cell/sample_robots.hpp"
#include "tests/core/cell/tool_derivatives.hpp"

namespace sculpt {
namespace {

// The mimic machine has shifts behind turns, seen from the stock: each order of the two counts.
TEST(MotionBound, HoldsForHigherDerivativesToo) {
  for (const SampleChain& sample : {arm_on_rail(), mimic_machine()}) {
    SCOPED_TRACE(sample.title);
    const Chain chain = sample.chain();
    const Configuration speed =
        motion_bound(chain, chain.stock_link(), chain.tool_link(), std::abs(chain.stickout_m()));
    const Configuration turn = turn_bound(chain, chain.stock_link(), chain.tool_link());
    double closest = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(seed);
      const Configuration q = random_configuration(chain, random, 0.1);
      Configuration step(chain.dof());
      for (Eigen::Index c = 0; c < step.size(); ++c) step[c] = random.unit() < 0.4 ? 0 : random.between(-1, 1);
      const DerivativeBounds bounds = derivative_bounds(chain, turn.dot(step.cwiseAbs()), speed.dot(step.cwiseAbs()));
      const ToolDerivatives found = tool_derivatives(chain, q, step);
      for (const ToolDerivatives::End& end : {found.ball, found.top}) {
        ASSERT_LE(end.second_m.norm(), bounds.second_m + 1e-5);
        ASSERT_LE(end.third_m.norm(), bounds.third_m + 1e-4);
        ASSERT_LE(end.fourth_m.norm(), bounds.fourth_m + 1e-2);
      }
      if (bounds.second_m > 0.01) closest = std::max(closest, found.ball.second_m.norm() / bounds.second_m);
    }
    EXPECT_GT(closest, 0.05) << "the bound says nothing";
  }
}

// One unit of a turn and one of a shift behind it, at once: the shift's direction turns, and that counts twice.
TEST(MotionBound, CountsAShiftBehindATurnInBothOrders) {
  const Robot robot = parse_plain(R"(<robot name="table-and-slide">
    <link name="disc"/> <link name="base"/> <link name="slider"/>
    <joint name="table" type="revolute"><parent link="base"/><child link="disc"/><axis xyz="0 0 1"/>
      <limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
    <joint name="slide" type="prismatic"><parent link="base"/><child link="slider"/><axis xyz="1 0 0"/>
      <limit lower="-0.001" upper="0.001" velocity="1" effort="1"/></joint>
  </robot>)");
  const Chain chain(robot, robot.find_link("disc"), robot.find_link("slider"), 0, {0, 0});
  const Configuration speed = motion_bound(chain, chain.stock_link(), chain.tool_link(), 0);
  const Configuration turn = turn_bound(chain, chain.stock_link(), chain.tool_link());
  const Configuration step = Configuration::Ones(2);
  const double found_m = tool_derivatives(chain, Configuration::Zero(2), step).ball.second_m.norm();
  EXPECT_NEAR(found_m, 2, 1e-3);
  EXPECT_GE(derivative_bounds(chain, turn.dot(step), speed.dot(step)).second_m, found_m - 1e-3);
}

}  // namespace
}  // namespace sculpt
