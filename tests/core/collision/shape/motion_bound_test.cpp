#include "core/collision/shape/motion_bound.hpp"

#include <gtest/gtest.h>

#include "tests/core/cell/sample_robots.hpp"
#include "tests/core/cell/tool_derivatives.hpp"
#include "tests/core/collision/shape/random_shapes.hpp"

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

// However far: the joints' whole ranges, not only small steps.
TEST(MotionBound, PointsOfTwoLinksComeNoNearerThanApproachBoundSays) {
  const Cell panda = shipped_cell("panda-turntable");
  for (const SampleChain& sample : {arm_on_rail(), mimic_machine(), shipped_chain(panda)}) {
    SCOPED_TRACE(sample.title);
    const Chain chain = sample.chain();
    const int links = static_cast<int>(sample.robot.links.size());
    std::vector<Frame> from, to;
    double closest = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(seed);
      const Configuration start = random_configuration(chain, random);
      const double far = seed % 2 == 0 ? 1e-3 : 0.3;
      Configuration end = start + far * (random_configuration(chain, random) - start);
      for (Eigen::Index c = 0; c < end.size(); ++c)
        if (random.unit() < 0.5) end[c] = start[c];
      const Configuration size = (end - start).cwiseAbs();
      chain.link_poses(start, from);
      chain.link_poses(end, to);
      for (int a = 0; a < links; ++a)
        for (int b = 0; b < links; ++b) {
          const LinkExtent first{a, random.between(0, 0.3)}, second{b, random.between(0, 0.3)};
          const Vec3 p = first.extent_m * random_direction(random), q = second.extent_m * random_direction(random);
          const auto distance = [&](const std::vector<Frame>& at) {
            return (at[static_cast<std::size_t>(a)] * p - at[static_cast<std::size_t>(b)] * q).norm();
          };
          const double nearer = distance(from) - distance(to), most = approach_bound(chain, first, second).dot(size);
          ASSERT_LE(nearer, most + 1e-9) << a << ' ' << b;
          if (most > 1e-6) closest = std::max(closest, nearer / most);
          ASSERT_LE(approach_bound(chain, first, second).sum(),
                    motion_bound(chain, a, b, second.extent_m).sum() + 1e-12);
          ASSERT_LE(approach_bound(chain, first, second).sum(),
                    motion_bound(chain, b, a, first.extent_m).sum() + 1e-12);
        }
    }
    EXPECT_GT(closest, 0.3) << "the bound says nothing";
  }
}

// A table of 0.1 m that an arm of a metre stands beside: turning the table brings nothing nearer by more than its own
// radius, however long the arm.
TEST(MotionBound, AJointMovesOnlyTheBodyThatItCarries) {
  const Robot robot = parse_plain(R"(<robot name="table-and-arm">
    <link name="disc"/> <link name="base"/> <link name="arm"/>
    <joint name="table" type="revolute"><parent link="base"/><child link="disc"/><axis xyz="0 0 1"/>
      <limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
    <joint name="shoulder" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
      <limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
  </robot>)");
  const int disc = robot.find_link("disc"), arm = robot.find_link("arm");
  const Chain chain(robot, disc, arm, 0, {0, 0});
  const Configuration bound = approach_bound(chain, {disc, 0.1}, {arm, 0.8});
  EXPECT_NEAR(bound[0], 0.1, 1e-12);
  EXPECT_NEAR(bound[1], 0.8, 1e-12);
}

}  // namespace
}  // namespace sculpt
