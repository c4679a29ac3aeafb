#include "core/timing/timed_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/timing/demand/motion_limits.hpp"
#include "core/timing/demand/motion_order.hpp"
#include "core/timing/motion/sampler.hpp"
#include "tests/core/timing/made_up_paths.hpp"

namespace sculpt {
namespace {

Keyframe move_to(const Configuration& q) {
  return {q, false, {}, {}};
}

std::string refusal(const PlanPath& path, const Cell& cell, const MotionDemands& demands) {
  try {
    time_plan(path, cell, demands);
    return "accepted";
  } catch (const InputError& error) {
    return error.code() + ": " + error.what();
  }
}

/// Of every piece at its ends, where accelerations are largest, and of the moving average at 1 kHz.
void expect_limits_kept(const PlanPath& path, const Cell& cell, const TimedPlan& plan) {
  const Chain chain = cell.chain();
  const MotionLimits limits = limits_of(cell, chain);
  MotionPieces pieces(path, plan.law);
  MotionPiece piece;
  double end_s = 0;
  Configuration at = path.configuration(0), velocity = Configuration::Zero(at.size());
  std::vector<std::pair<double, Configuration>> accelerations;
  while (pieces.next(piece)) {
    ASSERT_NEAR(piece.begin_s, end_s, 1e-9);
    ASSERT_GT(piece.seconds, 0);
    ASSERT_LE((piece.q(0) - at).cwiseAbs().maxCoeff(), 1e-9) << piece.point;
    ASSERT_LE((piece.velocity(0) - velocity).cwiseAbs().maxCoeff(), 1e-6) << piece.point;
    for (const double t : {0.0, piece.seconds}) {
      const double speed = piece.speed + piece.rise * t;
      const Configuration way = piece.way + piece.bend * ((piece.speed + piece.rise * t / 2) * t);
      const Configuration acceleration = way * piece.rise + piece.bend * speed * speed;
      ASSERT_LE(acceleration.cwiseAbs().cwiseQuotient(limits.acceleration).maxCoeff(), 1) << piece.point;
      ASSERT_LE(2 * acceleration.cwiseAbs().cwiseQuotient(limits.jerk).maxCoeff(), plan.law.window_s * (1 + 1e-12));
    }
    for (int part = 0; part <= 8; ++part)
      ASSERT_LE(piece.velocity(piece.seconds * part / 8).cwiseAbs().cwiseQuotient(limits.velocity).maxCoeff(), 1)
          << piece.point;
    end_s = piece.end_s();
    at = piece.q(piece.seconds);
    velocity = piece.velocity(piece.seconds);
  }
  ASSERT_LE((at - path.configuration(path.size() - 1)).cwiseAbs().maxCoeff(), 1e-9);
  ASSERT_LE(velocity.cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(end_s + plan.law.window_s, plan.time.total, 1e-6 * plan.time.total);
  MotionSampler sampler(path, plan.law);
  constexpr double step = 1e-3;
  MotionSample before = sampler.at(0);
  Configuration acceleration = Configuration::Zero(before.q.size());
  for (double t = step; t < sampler.duration_s() + step; t += step) {
    const MotionSample now = sampler.at(t);
    const Configuration mean = (now.q - before.q) / step, change = (now.velocity - before.velocity) / step;
    ASSERT_LE(mean.cwiseAbs().cwiseQuotient(limits.velocity).maxCoeff(), 1 + 1e-9) << t;
    ASSERT_LE(change.cwiseAbs().cwiseQuotient(limits.acceleration).maxCoeff(), 1 + 1e-9) << t;
    ASSERT_LE(((change - acceleration) / step).cwiseAbs().cwiseQuotient(limits.jerk).maxCoeff(), 1 + 1e-6) << t;
    acceleration = change;
    before = now;
  }
}

TEST(TimedPlan, LimitsAreKeptOnAnyPath) {
  for (const char* name : {"panda-turntable", "gantry"}) {
    const Cell cell = shipped_cell(name);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(std::string(name) + " seed " + std::to_string(seed));
      Random random(seed);
      const PlanPath path = path_of(cell, wander(cell, random, 1 + random.next() % 150));
      const MotionDemands demands{random.between(0.005, 0.3), random.between(0.1, 1), {}, 0};
      expect_limits_kept(path, cell, time_plan(path, cell, demands));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(TimedPlan, LowJerkIsKept) {
  Cell cell = shipped_cell("panda-turntable");
  for (JointLimits& limits : cell.limits) limits.jerk = limits.acceleration / 0.05;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PlanPath path = path_of(cell, wander(cell, random, 60));
    const TimedPlan plan = time_plan(path, cell, {0.05, 0.5, {}, 0});
    EXPECT_GT(plan.law.window_s, 0.004);
    expect_limits_kept(path, cell, plan);
    if (HasFatalFailure()) return;
  }
}

TEST(TimedPlan, OneEdgeIsATrapezoidAndAWindow) {
  const Cell cell = shipped_cell("gantry");
  Configuration q = cell.home(cell.chain());
  q[0] += 0.1;
  const PlanPath path = path_of(cell, {move_to(q)});
  const TimedPlan plan = time_plan(path, cell, {0.05, 0.2, {}, 0});
  const double window = 2 * 2.0 / 50, a = 50 * plan.law.window_s / 2;
  EXPECT_LE(plan.law.window_s, window * (1 + 1e-12));
  EXPECT_NEAR(plan.time.total, 0.1 / 0.2 + 0.2 / std::min(a, 2.0) + plan.law.window_s, 2e-3);
  expect_limits_kept(path, cell, plan);
}

TEST(TimedPlan, NothingToDoTakesNoTime) {
  const Cell cell = shipped_cell("gantry");
  const PlanPath path = path_of(cell, {move_to(cell.home(cell.chain()))});
  EXPECT_EQ(path.size(), 1u);
  const TimedPlan plan = time_plan(path, cell, {0.05, 0.2, {}, 0});
  EXPECT_EQ(plan.law.corners.size(), 1u);
  MotionSampler sampler(path, plan.law);
  EXPECT_EQ(sampler.duration_s(), 0);
  EXPECT_EQ(sampler.at(1).q, cell.home(cell.chain()));
}

TEST(TimedPlan, TheSameTwice) {
  const Cell cell = shipped_cell("panda-turntable");
  Random random(5);
  const PlanPath path = path_of(cell, wander(cell, random, 100));
  const TimedPlan one = time_plan(path, cell, {0.05, 0.5, {}, 0}), other = time_plan(path, cell, {0.05, 0.5, {}, 0});
  for (std::size_t at = 0; at < one.law.corners.size(); ++at) {
    EXPECT_EQ(one.law.corners[at].half, other.law.corners[at].half);
    EXPECT_EQ(one.law.corners[at].x_in, other.law.corners[at].x_in);
  }
  EXPECT_EQ(one.time.total, other.time.total);
}

TEST(TimedPlan, AStopEndsTheWork) {
  const Cell cell = shipped_cell("panda-turntable");
  Random random(6);
  const PlanPath path = path_of(cell, wander(cell, random, 1200));
  std::stop_source stop;
  EXPECT_NO_THROW(time_plan(path, cell, {0.05, 0.5, {}, 0}, stop.get_token()));
  stop.request_stop();
  EXPECT_THROW(time_plan(path, cell, {0.05, 0.5, {}, 0}, stop.get_token()), Cancelled);
}

TEST(MotionOrder, AFeedIsTheOrdersOrThatOfTheFastestTool) {
  std::vector<MillTool> tools(2);
  tools[0].feed_m_s = 0.02;
  tools[1].feed_m_s = 0.03;
  EXPECT_EQ(demands_of({}, tools).feed_m_s, 0.03);
  EXPECT_EQ(demands_of({0.01}, tools).feed_m_s, 0.01);
  const MotionDemands demands = demands_of({0.05, 0.2, 0.9}, {});
  EXPECT_EQ(demands.rapid_m_s, 0.2);
  EXPECT_EQ(demands.keep_feed, 0.9);
}

TEST(MotionOrder, WhatIsNoOrderIsRefusedBeforeThereIsAPlan) {
  const auto word = [](const MotionOrder& order, const Cell& cell) {
    try {
      check_order(order, cell, {});
      return std::string("accepted");
    } catch (const InputError& error) {
      return error.code();
    }
  };
  Cell cell = shipped_cell("gantry");
  EXPECT_EQ(word({0.05}, cell), "accepted");
  for (const MotionOrder& order : std::vector<MotionOrder>{
           {}, {0.0}, {-1.0}, {std::nan("")}, {0.05, 0}, {0.05, INFINITY}, {0.05, 0.5, 0.0}, {0.05, 0.5, 1.01}})
    EXPECT_EQ(word(order, cell), "feed_invalid");
  for (JointLimits& limits : cell.limits) limits.jerk = 0;
  EXPECT_EQ(word({0.05}, cell), "limits_missing");
}

TEST(TimedPlan, WhatCannotBeDoneIsRefusedWithTheCure) {
  Cell cell = shipped_cell("gantry");
  Configuration q = cell.home(cell.chain());
  q[0] += 0.1;
  const PlanPath path = path_of(cell, {move_to(q)});
  EXPECT_NE(refusal(path, cell, {0, 0.2, {}, 0}).find("feed_invalid"), std::string::npos);
  EXPECT_NE(refusal(path, cell, {0.1, -1, {}, 0}).find("give one above 0"), std::string::npos);
  EXPECT_NE(refusal(path, cell, {0.1, 1e-12, {}, 0}).find("give 1e-6 m/s or more"), std::string::npos);
  EXPECT_NE(refusal(path, cell, {0.1, 1, {}, 1}).find("reserve less"), std::string::npos);
  EXPECT_NE(refusal(path, shipped_cell("panda-turntable"), {0.1, 1, {}, 0}).find("--robot"), std::string::npos);
  cell.limits[static_cast<std::size_t>(cell.robot.find_joint("x"))].jerk = 0;
  EXPECT_NE(refusal(path, cell, {0.1, 1, {}, 0}).find("limits_missing"), std::string::npos);
  EXPECT_NE(refusal(path, cell, {0.1, 1, {}, 0}).find("\"limits\""), std::string::npos);
}

TEST(TimedPlan, AFeedThatIsNotKeptIsRefusedWithItsPlace) {
  const Cell cell = shipped_cell("gantry");
  Configuration q = cell.home(cell.chain());
  std::vector<Keyframe> keyframes;
  for (int at = 0; at < 12; ++at) {  // to and fro, cutting all the way
    q[0] = at % 2 == 0 ? 0.05 : -0.05;
    keyframes.push_back({q, true, {at % 2 == 0 ? 15 : 0, 3, 3}, {at % 2 == 0 ? 4 : 11, 3, 3}});
  }
  const PlanPath path = path_of(cell, keyframes);
  const std::string said = refusal(path, cell, {0.49, 0.5, 0.95, 0});
  EXPECT_NE(said.find("feed_not_kept"), std::string::npos) << said;
  EXPECT_NE(said.find("keyframe"), std::string::npos);
  EXPECT_NE(said.find("'x'"), std::string::npos);
  EXPECT_EQ(refusal(path, cell, {0.001, 0.5, 0.95, 0}), "accepted");
}

}  // namespace
}  // namespace sculpt
