#include "core/cell/ik.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

void expect_met(const Chain& chain, const IkGoal& goal, const Configuration& q) {
  const IkSettings settings;
  const ToolPose pose = chain.tool_pose(q);
  EXPECT_LE((pose.ball_m - goal.ball_m).norm(), settings.position_tolerance_m);
  if (goal.axis) {
    const double angle = std::atan2(pose.axis.cross(*goal.axis).norm(), pose.axis.dot(*goal.axis));
    EXPECT_LE(angle, settings.axis_tolerance_rad);
  }
  EXPECT_TRUE(chain.within_limits(q));
}

IkGoal goal_at(const Chain& chain, const Configuration& q, bool with_axis) {
  const ToolPose pose = chain.tool_pose(q);
  return {pose.ball_m, with_axis ? std::optional<Vec3>(pose.axis) : std::nullopt};
}

/// How many of `count` goals, taken from random configurations, are reached from the seed that `make_seed` gives.
template <typename MakeSeed>
int count_reached(const Chain& chain, int count, bool with_axis, MakeSeed make_seed) {
  int reached = 0;
  for (int seed = 0; seed < count; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const Configuration target = random_configuration(chain, random);
    const IkGoal goal = goal_at(chain, target, with_axis);
    const auto q = solve_ik(chain, goal, make_seed(target, random));
    if (!q) continue;
    ++reached;
    expect_met(chain, goal, *q);
  }
  return reached;
}

TEST(Ik, EveryGoalIsReachedFromANearbySeed) {
  for (const char* name : {"panda-turntable", "gantry"}) {
    SCOPED_TRACE(name);
    const Cell cell = shipped_cell(name);
    const Chain chain = cell.chain();
    const auto nearby = [&](const Configuration& target, Random& random) {
      Configuration seed = target;
      for (double& value : seed) value += random.between(-0.05, 0.05);
      return seed;
    };
    for (bool with_axis : {false, true}) {
      SCOPED_TRACE(with_axis);
      EXPECT_EQ(count_reached(chain, 1000, with_axis, nearby), 1000);
    }
  }
}

TEST(Ik, MostGoalsAreReachedFromTheMiddleOfTheLimits) {
  const Cell cell = shipped_cell("panda-turntable");
  const Chain chain = cell.chain();
  const Configuration middle = (chain.lower() + chain.upper()) / 2;
  const auto from_middle = [&](const Configuration&, Random&) { return middle; };
  const int with_axis = count_reached(chain, 500, true, from_middle);
  const int position_only = count_reached(chain, 500, false, from_middle);
  RecordProperty("with_axis_of_500", with_axis);
  RecordProperty("position_only_of_500", position_only);
  EXPECT_GE(with_axis, 450);
  EXPECT_GE(position_only, 490);
}

TEST(Ik, MachinesOfFewAxesReachPositions) {
  for (const SampleChain& sample : {arm_on_rail(), mimic_machine()}) {
    SCOPED_TRACE(sample.title);
    const Chain chain = sample.chain();
    const auto nearby = [&](const Configuration& target, Random& random) {
      Configuration seed = target;
      for (double& value : seed) value += random.between(-0.02, 0.02);
      return seed;
    };
    // A machine of three axes has singular poses, and near one of those the only solution may not be found.
    EXPECT_GE(count_reached(chain, 300, false, nearby), 290);
  }
}

TEST(Ik, TracksARowVoxelByVoxelWithoutJumps) {
  const Cell cell = shipped_cell("panda-turntable");
  const Chain chain = cell.chain();
  IkSettings settings;
  settings.centring = 0;
  std::optional<Configuration> q = cell.home(chain);
  const double voxel_m = cell.stock_size_m / 64;
  for (int i = 0; i < 64; ++i) {
    SCOPED_TRACE(i);
    const IkGoal goal{Vec3(-0.1 + voxel_m * (i + 0.5), 0.02, 0.21), Vec3::UnitZ()};
    const Configuration before = *q;
    q = solve_ik(chain, goal, before, settings);
    ASSERT_TRUE(q);
    expect_met(chain, goal, *q);
    if (i > 0) {
      EXPECT_LT((*q - before).cwiseAbs().maxCoeff(), 0.05);
    }
  }
}

TEST(Ik, UnreachableGoalGivesNothing) {
  const Cell panda = shipped_cell("panda-turntable"), gantry = shipped_cell("gantry");
  const Chain arm = panda.chain(), axes = gantry.chain();
  EXPECT_FALSE(solve_ik(arm, {Vec3(3, 0, 0), Vec3::UnitZ()}, panda.home(arm)));
  EXPECT_FALSE(solve_ik(axes, {Vec3(0.17, 0, 0.1), std::nullopt}, gantry.home(axes))) << "past the limit of x";
  EXPECT_FALSE(solve_ik(axes, {Vec3(0, 0, 0.1), Vec3::UnitX()}, gantry.home(axes))) << "the gantry cannot tilt";
}

TEST(Ik, LimitsAreLeftOnlyWhenAsked) {
  const Cell gantry = shipped_cell("gantry");
  const Chain chain = gantry.chain();
  IkSettings settings;
  settings.respect_limits = false;
  const auto q = solve_ik(chain, {Vec3(0.17, 0, 0.1), std::nullopt}, gantry.home(chain), settings);
  ASSERT_TRUE(q);
  EXPECT_NEAR((*q)[0], 0.17, 1e-6);
}

TEST(Ik, SeedOutsideTheLimitsIsNoExcuse) {
  const Cell cell = shipped_cell("panda-turntable");
  const Chain chain = cell.chain();
  const IkGoal goal{Vec3(0, 0, 0.15), Vec3::UnitZ()};
  const Configuration wild = cell.home(chain) + Configuration::Constant(chain.dof(), 4.0);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Configuration start = wild;
    for (double& value : start) value += random.between(-8, 4);
    const auto q = solve_ik(chain, goal, start);
    if (q) expect_met(chain, goal, *q);
  }
  EXPECT_TRUE(solve_ik(chain, goal, cell.home(chain)));
}

TEST(Ik, CentringMovesTheSpareFreedomTowardsMidRange) {
  const Cell cell = shipped_cell("panda-turntable");
  const Chain chain = cell.chain();
  Configuration seed = cell.home(chain);
  seed[7] = 2.5;  // coaxial with the tool: it can turn without any effect
  const IkGoal goal{Vec3(0.05, 0.05, 0.1), Vec3::UnitZ()};
  IkSettings still;
  still.centring = 0;
  const auto kept = solve_ik(chain, goal, seed, still), centred = solve_ik(chain, goal, seed);
  ASSERT_TRUE(kept && centred);
  EXPECT_NEAR((*kept)[7], 2.5, 1e-9);
  EXPECT_LT((*centred)[7], 2.4);
}

}  // namespace
}  // namespace sculpt
