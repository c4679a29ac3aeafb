#include "core/sweep/field/posture_lanes.hpp"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cstring>
#include <limits>

#include "core/base/random.hpp"
#include "core/trajectory/quantum.hpp"
#include "tests/core/cell/sample_robots.hpp"
#include "tests/core/cell/tool_derivatives.hpp"

namespace sculpt {
namespace {

const Cell& panda() {
  static const Cell cell = shipped_cell("panda-turntable");
  return cell;
}

std::vector<SampleChain> sample_chains() {
  return {arm_on_rail(), mimic_machine(), shipped_chain(panda()), shipped_chain(shipped_cell("gantry"))};
}

Configuration nearby(const Configuration& q, Random& random, double most) {
  return q.unaryExpr([&](double value) { return value + random.between(-most, most); });
}

/// Around one pose of the tool, each lane with a ball of its own.
struct Around {
  Around(const Chain& chain, std::uint64_t seed, double ball_away_m, double guess_away, double limit_margin = 0.05)
      : random(seed), q(random_configuration(chain, random, limit_margin)), pose(chain.tool_pose(q)) {
    for (int lane = 0; lane < lane_count; ++lane) {
      balls.push_back(pose.ball_m);
      for (int row = 0; row < 3; ++row) balls.back()[row] += random.between(-ball_away_m, ball_away_m);
      batch.set(lane, balls.back(), nearby(q, random, guess_away));
    }
  }

  Random random;
  Configuration q;
  ToolPose pose;
  std::vector<Vec3> balls;
  PostureBatch batch;
};

bool same_bits(const Lanes& a, const Lanes& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * lane_count) == 0;
}

TEST(PostureLanes, SayHowFarTheToolIsFromWhereItShouldBe) {
  int solved = 0;
  for (const SampleChain& sample : sample_chains()) {
    const Chain chain = sample.chain();
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      SCOPED_TRACE(sample.title + ", seed " + std::to_string(seed));
      Around around(chain, seed, 0.002, 0.01);
      PostureBatch& batch = around.batch;
      PostureLanes(chain, around.pose.axis).solve(batch);
      for (int lane = 0; lane < lane_count; ++lane) {
        const auto at = static_cast<std::size_t>(lane);
        if (!batch.solved(lane)) continue;
        ++solved;
        const Configuration q = batch.q.get(lane, chain.dof());
        ASSERT_EQ(q, rounded(q));
        ASSERT_TRUE(chain.within_limits(q));
        const ToolPose pose = chain.tool_pose(q);
        const Vec3 off = pose.ball_m - around.balls[at];
        const Vec3 top_off = off + chain.stickout_m() * (pose.axis - around.pose.axis);
        ASSERT_NEAR(batch.ball_off_m[at], off.norm(), 1e-13);
        ASSERT_NEAR(batch.top_off_m[at], top_off.norm(), 1e-13);
      }
    }
  }
  EXPECT_GT(solved, 3000);
}

TEST(PostureLanes, FindThePostureNearAGuess) {
  const Chain chain = shipped_chain(panda()).chain();
  int near = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Around around(chain, seed, 0.0005, 0.0005);
    PostureLanes(chain, around.pose.axis).solve(around.batch);
    for (int lane = 0; lane < lane_count; ++lane) {
      ++all;
      if (!around.batch.solved(lane)) continue;
      near += around.batch.ball_off_m[static_cast<std::size_t>(lane)] < 1e-6 &&
              around.batch.top_off_m[static_cast<std::size_t>(lane)] < 1e-6;
    }
  }
  EXPECT_GT(near, all * 9 / 10) << "the others are near a singular configuration or a limit";
}

TEST(PostureLanes, MoreStepsCloseALargerGap) {
  const Chain chain = shipped_chain(panda()).chain();
  int few = 0, many = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Around around(chain, seed, 0.01, 0.02, 0.1);
    const PostureLanes lanes(chain, around.pose.axis);
    PostureBatch after_one = around.batch, after_four = around.batch;
    lanes.solve(after_one, 1);
    lanes.solve(after_four, 4);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      ++all;
      few += after_one.ball_off_m[lane] < 1e-6;
      many += after_four.ball_off_m[lane] < 1e-6;
    }
  }
  EXPECT_LT(few, all / 2);
  EXPECT_GT(many, all * 3 / 4);
}

TEST(PostureLanes, ArePulledWhereTheToolLeavesFreedom) {
  const Chain chain = shipped_chain(panda()).chain();
  const NullSpaceGoal goal{(chain.lower() + chain.upper()) / 2, 0.3};
  int nearer = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Around around(chain, seed, 0.01, 0.01, 0.1);
    const PostureLanes lanes(chain, around.pose.axis);
    PostureBatch free = around.batch, pulled = around.batch;
    lanes.solve(free, 6);
    lanes.solve(pulled, 6, &goal);
    for (int lane = 0; lane < lane_count; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      if (!free.solved(lane) || !pulled.solved(lane) || free.ball_off_m[at] > 1e-6 || pulled.ball_off_m[at] > 1e-6)
        continue;
      ++all;
      nearer += (pulled.q.get(lane, chain.dof()) - goal.towards).norm() <
                (free.q.get(lane, chain.dof()) - goal.towards).norm();
    }
  }
  EXPECT_GT(all, 1000);
  EXPECT_GT(nearer, all * 9 / 10);
}

TEST(PostureLanes, RefuseEachLaneOnItsOwn) {
  const Chain chain = shipped_chain(panda()).chain();
  Around around(chain, 3, 0.0005, 0.0005, 0.3);
  const PostureLanes lanes(chain, around.pose.axis);
  PostureBatch batch = around.batch;
  lanes.solve(batch);
  for (int lane = 0; lane < lane_count; ++lane) ASSERT_TRUE(batch.solved(lane));

  PostureBatch spoilt = around.batch;
  spoilt.set(1, around.balls[1] + Vec3(5, 0, 0), around.q);
  spoilt.set(2, around.balls[2], Configuration::Constant(chain.dof(), std::numeric_limits<double>::quiet_NaN()));
  Configuration outside = around.q;
  outside[0] += 7;  // the turntable, more than once around
  outside[1] += 7;
  spoilt.set(3, around.balls[3], outside);
  lanes.solve(spoilt);
  for (int lane = 0; lane < lane_count; ++lane) {
    const bool fine = lane < 1 || lane > 3;
    ASSERT_EQ(spoilt.solved(lane), fine) << lane;
    if (fine) {
      ASSERT_EQ(spoilt.q.get(lane, chain.dof()), batch.q.get(lane, chain.dof())) << lane;
    }
  }
}

TEST(PostureLanes, RefuseAToolUpsideDown) {
  const Chain chain = shipped_chain(panda()).chain();
  Around around(chain, 3, 0, 0, 0.3);
  PostureLanes(chain, -around.pose.axis).solve(around.batch);
  for (int lane = 0; lane < lane_count; ++lane) EXPECT_FALSE(around.batch.solved(lane));
}

TEST(PostureLanes, BendAsTheDifferencesOfTheToolSay) {
  for (const SampleChain& sample : sample_chains()) {
    const Chain chain = sample.chain();
    const PostureLanes lanes(chain, Vec3(0.36, 0.48, 0.8));
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      SCOPED_TRACE(sample.title + ", seed " + std::to_string(seed));
      Random random(seed);
      EdgeBatch edges;
      for (int lane = 0; lane < lane_count; ++lane) {
        const Configuration from = random_configuration(chain, random);
        edges.from.set(lane, from);
        edges.to.set(lane, nearby(from, random, 0.7));
      }
      lanes.derive(edges);
      for (int lane = 0; lane < lane_count; ++lane) {
        const Configuration from = edges.from.get(lane, chain.dof()), step = edges.to.get(lane, chain.dof()) - from;
        const auto [ball, top] = tool_derivatives(chain, from + 0.5 * step, step);
        const auto at = static_cast<std::size_t>(lane);
        ASSERT_NEAR(edges.ball_second_derivative[at], ball.second_m.norm(), 1e-5);
        ASSERT_NEAR(edges.top_second_derivative[at], top.second_m.norm(), 1e-5);
        ASSERT_NEAR(edges.ball_third_derivative[at], ball.third_m.norm(), 1e-4);
        ASSERT_NEAR(edges.top_third_derivative[at], top.third_m.norm(), 1e-4);
      }
    }
  }
}

/// A pointer of 1 m on one joint: the ball is at cosine and sine of its value.
constexpr const char* pointer_urdf = R"(<robot name="pointer">
  <link name="face"/> <link name="pointer"/>
  <joint name="turn" type="revolute">
    <parent link="face"/> <child link="pointer"/> <axis xyz="0 0 1"/>
    <limit lower="-2000" upper="2000" velocity="1" effort="1"/>
  </joint>
  <link name="end"/>
  <joint name="mount" type="fixed">
    <parent link="pointer"/> <child link="end"/> <origin xyz="1 0 0" rpy="3.14159265358979323846 0 0"/>
  </joint>
</robot>)";

TEST(PostureLanes, KnowSineAndCosine) {
  const SampleChain sample{"pointer", parse_plain(pointer_urdf), "face", "end", 0};
  const Chain chain = sample.chain();
  const PostureLanes lanes(chain, Vec3::UnitZ());
  Random random(1);
  double worst = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const double most = trial % 2 ? 10 : 1000;
    PostureBatch batch;
    Lanes angles;
    for (int lane = 0; lane < lane_count; ++lane) {
      const Configuration angle = rounded(Configuration::Constant(1, random.between(-most, most)));
      angles[static_cast<std::size_t>(lane)] = angle[0];
      batch.set(lane, Vec3(std::cos(angle[0]), std::sin(angle[0]), 0), angle);
    }
    lanes.solve(batch);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      ASSERT_EQ(batch.q.joints[0][lane], angles[lane]);
      worst = std::max(worst, batch.ball_off_m[lane]);
    }
  }
  EXPECT_LT(worst, 1e-15);
}

TEST(PostureLanes, GiveTheSameBitsOnAllTargets) {
  std::int64_t targets = hwy::SupportedTargets();
  int tried = 0;
  for (const SampleChain& sample : sample_chains()) {
    const Chain chain = sample.chain();
    const NullSpaceGoal goal{(chain.lower() + chain.upper()) / 2, 0.1};
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE(sample.title + ", seed " + std::to_string(seed));
      const Around around(chain, seed, 0.005, 0.01);
      const PostureLanes lanes(chain, around.pose.axis);
      PostureBatch first = around.batch;
      EdgeBatch first_edges;
      for (std::int64_t left = targets; left != 0; left &= left - 1) {
        hwy::SetSupportedTargetsForTest(left & -left);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        PostureBatch batch = around.batch;
        lanes.solve(batch, 2, &goal);
        EdgeBatch edges;
        edges.from = around.batch.q;
        edges.to = batch.q;
        lanes.derive(edges);
        if (left == targets) {
          first = batch;
          first_edges = edges;
        }
        ++tried;
        for (int c = 0; c < chain.dof(); ++c) {
          const auto joint = static_cast<std::size_t>(c);
          ASSERT_TRUE(same_bits(batch.q.joints[joint], first.q.joints[joint]));
        }
        ASSERT_TRUE(same_bits(batch.ball_off_m, first.ball_off_m));
        ASSERT_TRUE(same_bits(batch.top_off_m, first.top_off_m));
        ASSERT_TRUE(same_bits(edges.ball_second_derivative, first_edges.ball_second_derivative));
        ASSERT_TRUE(same_bits(edges.top_second_derivative, first_edges.top_second_derivative));
        ASSERT_TRUE(same_bits(edges.ball_third_derivative, first_edges.ball_third_derivative));
        ASSERT_TRUE(same_bits(edges.top_third_derivative, first_edges.top_third_derivative));
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_GT(tried, 80) << "there is more than one target";
}

}  // namespace
}  // namespace sculpt
