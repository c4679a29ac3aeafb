// Laws of the time law's own making are clean; each planted fault is found. What makes laws is only called here.
#include "core/verify/timed/check_motion.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/law/coarse.hpp"
#include "core/timing/timed_plan.hpp"
#include "core/trajectory/reader.hpp"
#include "tests/core/timing/made_up_paths.hpp"

namespace sculpt {
namespace {

/// A plan as text, and its law.
struct Timed {
  Cell cell;
  std::string plan;
  LawFile law;

  MotionVerdict check() const {
    std::istringstream in(plan);
    return check_motion(in, law, cell, {});
  }
};

std::string text_of(const Cell& cell, const std::vector<Keyframe>& keyframes, double tolerance_voxels = 0.04) {
  const Chain chain = cell.chain();
  TrajectoryHeader header;
  header.joints = chain.names();
  header.home = cell.home(chain);
  header.grid = cell.grid(16);
  header.tool = make_tool(cell.tool, header.grid.voxel_m);
  header.tolerance_m = tolerance_voxels * header.grid.voxel_m;
  header.cell = cell.name;
  header.search = "sweep";
  std::ostringstream out;
  TrajectoryWriter writer(out, header);
  for (const Keyframe& keyframe : keyframes) writer.add(keyframe);
  writer.finish();
  return out.str();
}

Timed timed(Cell cell, const std::vector<Keyframe>& keyframes, double feed_m_s) {
  Timed made{std::move(cell), {}, {}};
  made.plan = text_of(made.cell, keyframes);
  std::istringstream in(made.plan);
  const PlanPath path(in);
  made.law.law = time_plan(path, made.cell, {feed_m_s, 0.5, {}, 0}).law;
  for (const Keyframe& keyframe : keyframes) made.law.plan.add(keyframe.q);
  return made;
}

Timed sample(std::uint64_t seed, const char* cell = "panda-turntable") {
  Random random(seed);
  Cell shipped = shipped_cell(cell);
  const auto keyframes = wander(shipped, random, 80);
  return timed(std::move(shipped), keyframes, random.between(0.01, 0.2));
}

std::string said(const MotionVerdict& verdict) {
  std::string all;
  for (const MotionFinding& finding : verdict.findings)
    all += std::to_string(finding.keyframe) + ": " + finding.sentence + "\n";
  return all;
}

TEST(CheckMotion, WhatTheLawMakesIsClean) {
  for (const char* cell : {"panda-turntable", "gantry", "six-axis-turntable"})
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      SCOPED_TRACE(std::string(cell) + " seed " + std::to_string(seed));
      const Timed one = sample(seed, cell);
      const MotionVerdict verdict = one.check();
      EXPECT_EQ(verdict.faults, 0u) << said(verdict);
      EXPECT_GT(verdict.pieces, 10u);
      EXPECT_GT(verdict.jerk, 0.9);
      EXPECT_LE(verdict.acceleration, 1);
      EXPECT_LE(verdict.jerk, 1 + 1e-9);
      EXPECT_LE(verdict.ball_voxels, 0.04);
      EXPECT_LE(verdict.links_m, 0.15e-3);
      EXPECT_LE(verdict.feed_m_s, one.law.law.feed_m_s * (1 + 1e-6));
    }
}

TEST(CheckMotion, AKeyframeOffByAThousandthOfADegreeIsFound) {
  Timed one = sample(1);
  std::istringstream in(one.plan);
  TrajectoryReader reader(in);
  std::vector<Keyframe> keyframes;
  while (auto keyframe = reader.next()) keyframes.push_back(*keyframe);
  keyframes[40].q[3] = from_quanta(*to_quanta(keyframes[40].q[3]) + 175);
  one.plan = text_of(one.cell, keyframes);
  EXPECT_NE(said(one.check()).find("other keyframes"), std::string::npos);
}

TEST(CheckMotion, SpeedPlusOnePercentIsFound) {
  for (const double share : {1.01 * 1.01}) {
    Timed one = sample(2);
    for (LawCorner& corner : one.law.law.corners) {
      corner.cruise = static_cast<float>(corner.cruise * 1.01f);
      for (float* x : {&corner.x_in, &corner.x_mid, &corner.x_out}) *x = static_cast<float>(*x * share);
    }
    const MotionVerdict verdict = one.check();
    EXPECT_GT(verdict.faults, 0u);
    EXPECT_NE(said(verdict).find("acceleration"), std::string::npos);
  }
}

TEST(CheckMotion, EachLimitHalvedAfterwardsIsFound) {
  const Timed one = sample(3);
  for (const char* joint : {"table", "joint1", "joint4", "joint6"})
    for (double JointLimits::*limit : {&JointLimits::acceleration, &JointLimits::jerk}) {
      Timed halved = one;
      (halved.cell.limits[static_cast<std::size_t>(halved.cell.robot.find_joint(joint))].*limit) /= 2;
      const MotionVerdict verdict = halved.check();
      EXPECT_GT(verdict.faults, 0u) << joint;
      EXPECT_NE(said(verdict).find(joint), std::string::npos);
    }
  Timed slow = one;
  slow.law.law.feed_m_s /= 2;
  EXPECT_NE(said(slow.check()).find("feed"), std::string::npos);
}

TEST(CheckMotion, AVelocityHalvedAfterwardsIsFound) {
  Cell cell = shipped_cell("gantry");
  Configuration q = cell.home(cell.chain());
  q[1] = 0.15;
  Timed one = timed(std::move(cell), {{q, false, {}, {}}}, 0.1);
  EXPECT_EQ(one.check().faults, 0u);
  one.cell.limits[static_cast<std::size_t>(one.cell.robot.find_joint("y"))].velocity /= 2;
  EXPECT_NE(said(one.check()).find("velocity of joint 'y'"), std::string::npos);
}

TEST(CheckMotion, TimeThatDoesNotGoOnIsFound) {
  Timed one = sample(4);
  std::size_t at = 0;
  while (!(one.law.law.corners[at].half > 0)) ++at;
  LawCorner& corner = one.law.law.corners[at];
  corner.x_in = corner.x_mid = corner.x_out = 0;
  EXPECT_NE(said(one.check()).find("time does not go on"), std::string::npos);
}

TEST(CheckMotion, ParabolasThatAreTooWideOrOverlapAreFound) {
  Timed one = sample(5);
  for (LawCorner& corner : one.law.law.corners) corner.half = static_cast<float>(rounded_down(corner.half * 1.5));
  EXPECT_GT(one.check().faults, 0u);
}

TEST(CheckMotion, ALawOfAnotherPlanIsFound) {
  Timed one = sample(6);
  one.law = sample(7).law;
  EXPECT_GT(one.check().faults, 0u);
  one.law.law.acceleration.pop_back();
  EXPECT_NE(said(one.check()).find("joints"), std::string::npos);
}

}  // namespace
}  // namespace sculpt
