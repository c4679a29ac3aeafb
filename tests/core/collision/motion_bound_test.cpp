#include "core/collision/motion_bound.hpp"

#include <gtest/gtest.h>

#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

/// Derivatives by t of the ball's centre along q + t * step, by central differences.
struct Derivatives {
  double second_m, third_m;
};
Derivatives derivatives(const Chain& chain, const Configuration& q, const Configuration& step) {
  const double h = 1e-3;
  const auto ball = [&](double t) { return chain.tool_pose(q + t * step).ball_m; };
  const Vec3 second = (ball(h) - 2 * ball(0) + ball(-h)) / (h * h);
  const Vec3 third = (ball(2 * h) - 2 * ball(h) + 2 * ball(-h) - ball(-2 * h)) / (2 * h * h * h);
  return {second.norm(), third.norm()};
}

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
      const Derivatives found = derivatives(chain, q, step);
      ASSERT_LE(found.second_m, bounds.second_m + 1e-5);
      ASSERT_LE(found.third_m, bounds.third_m + 1e-4);
      if (bounds.second_m > 0.01) closest = std::max(closest, found.second_m / bounds.second_m);
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
  const Derivatives found = derivatives(chain, Configuration::Zero(2), step);
  EXPECT_NEAR(found.second_m, 2, 1e-3);
  EXPECT_GE(derivative_bounds(chain, turn.dot(step), speed.dot(step)).second_m, found.second_m - 1e-3);
}

}  // namespace
}  // namespace sculpt
