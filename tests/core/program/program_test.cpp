// Programs of every dialect, read back and held against the plan; what does not fit is refused with its cure.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/program/program_cases.hpp"

namespace sculpt {
namespace {

// The axes in the order of the letters, as joints of the plan. A1 is a1, E1 the table.
std::vector<std::string> joints_of(const Case& one) {
  if (one.dialect == Dialect::gcode) return {"x", "y", "z"};
  if (one.dialect == Dialect::urscript)
    return {"shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"};
  return {"a1", "a2", "a3", "a4", "a5", "a6", "table"};
}

TEST(Program, EveryPartSaysWhatThePlanSays) {
  for (const Case& one : cases) {
    const Cell cell = shipped_cell(one.cell);
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(std::string(facts_of(one.dialect).name) + " seed " + std::to_string(seed));
      Random random(seed);
      const PlanPath path = path_of(cell, wander(cell, random, 1 + random.next() % 60), 8);
      if (path.size() < 2) continue;
      ProgramDemands demands = demands_of(one.dialect);
      demands.part_keyframes = 7;
      const Made made = make(path, cell, demands);
      EXPECT_EQ(made.report.parts, (path.size() - 1 + 6) / 7);
      std::size_t point = 0;
      for (std::size_t part = 1; part <= made.report.parts; ++part) {
        const std::string name =
            ProgramNames{"bust", part, made.report.parts, {}}.part_name() + facts_of(one.dialect).extension;
        const ReadPart read = read_part(one.dialect, made.files.at(name), one.letters);
        const auto expect_at = [&](std::size_t at, const std::vector<double>& values) {
          const auto names = joints_of(one);
          ASSERT_EQ(values.size(), names.size());
          for (std::size_t axis = 0; axis < names.size(); ++axis) {
            const auto& joints = path.header().joints;
            const auto joint = std::ranges::find(joints, names[axis]) - joints.begin();
            const double scale = one.dialect == Dialect::gcode ? 1000 : read.radians ? 1 : 180 / std::numbers::pi;
            ASSERT_NEAR(values[axis], path.point(at)[joint] * scale, one.dialect == Dialect::fanuc ? 6e-4 : 2e-5);
          }
        };
        expect_at(point, read.start);
        for (const ReadMove& move : read.moves) {
          expect_at(++point, move.values);
          EXPECT_TRUE(move.seconds > 0 || (move.share > 0 && move.share <= 1));
        }
      }
      EXPECT_EQ(point + 1, path.size());
      EXPECT_EQ(made.files.contains("bust" + std::string(facts_of(one.dialect).extension)),
                facts_of(one.dialect).has_main);
    }
  }
}

TEST(Program, EachPartSaysHowManyVoxelsAreCutBeforeItAndWithIt) {
  for (const Case& one : cases) {
    SCOPED_TRACE(facts_of(one.dialect).name);
    const Cell cell = shipped_cell(one.cell);
    Random random(5);
    const std::vector<Keyframe> keyframes = wander(cell, random, 60);
    const PlanPath path = path_of(cell, keyframes, 8);
    ProgramDemands demands = demands_of(one.dialect);
    demands.part_keyframes = 9;
    std::uint64_t cut = 0;
    for (const ReadPart& part : read_parts(one, make(path, cell, demands))) {
      EXPECT_EQ(part.cut_before, cut);
      EXPECT_GE(part.cut_after, cut);
      cut = part.cut_after;
    }
    const auto is_cut = [](const Keyframe& keyframe) { return keyframe.cut; };
    EXPECT_EQ(cut, static_cast<std::uint64_t>(std::ranges::count_if(keyframes, is_cut))) << "of one voxel each";
  }
}

TEST(Program, ATrajectoryForRosRisesInTimeAndEndsAtThePlansEnd) {
  const Cell cell = shipped_cell("panda-turntable");
  Random random(8);
  const PlanPath path = path_of(cell, wander(cell, random, 40));
  const Made made = make(path, cell, demands_of(Dialect::ros2));
  const std::string& text = made.files.at("bust.yaml");
  long long before = -1;
  std::size_t count = 0;
  for (std::size_t at = text.find("{sec: "); at != std::string::npos; at = text.find("{sec: ", at + 1)) {
    long long seconds = 0, nanoseconds = 0;
    ASSERT_EQ(std::sscanf(text.c_str() + at, "{sec: %lld, nanosec: %lld}", &seconds, &nanoseconds), 2);
    ASSERT_LT(nanoseconds, 1'000'000'000);
    ASSERT_GT(seconds * 1'000'000'000 + nanoseconds, before);
    before = seconds * 1'000'000'000 + nanoseconds;
    ++count;
  }
  EXPECT_EQ(count, made.report.moves);
  EXPECT_EQ(text.find('e', text.find("points:") + 8) == std::string::npos, false);  // words have one
  EXPECT_EQ(text.find("e-"), std::string::npos);
}

TEST(Program, WhatDoesNotFitIsRefusedWithTheCure) {
  Random random(1);
  Cell six = shipped_cell("six-axis-turntable");
  const Cell panda = shipped_cell("panda-turntable"), ur = shipped_cell("ur10e-plinth");
  const PlanPath path = path_of(six, wander(six, random, 20), 8), arm = path_of(panda, wander(panda, random, 20));
  EXPECT_NE(refusal(arm, panda, demands_of(Dialect::krl)).find("axes_unfit"), std::string::npos);
  EXPECT_NE(refusal(path, six, demands_of(Dialect::urscript)).find("stock must stand still"), std::string::npos);
  EXPECT_NE(refusal(path, six, demands_of(Dialect::gcode)).find("X, Y, Z"), std::string::npos);
  ProgramDemands demands = demands_of(Dialect::krl);
  for (const char* name : {"", "Bust", "7up", "a-b", "a_name_that_is_too_long"}) {
    demands.name = name;
    EXPECT_NE(refusal(path, six, demands).find("name_invalid"), std::string::npos) << name;
  }
  demands = demands_of(Dialect::krl);
  demands.part_keyframes = 0;
  EXPECT_NE(refusal(path, six, demands).find("part_invalid"), std::string::npos);
  demands = demands_of(Dialect::krl);
  demands.motion.feed_m_s = 0;
  EXPECT_NE(refusal(path, six, demands).find("feed_invalid"), std::string::npos);
  demands.motion.feed_m_s = 1e-6;
  demands.motion.rapid_m_s = 1e-6;
  EXPECT_NE(refusal(path, six, demands).find("speed_too_coarse"), std::string::npos);
  // Three decimals of a degree are too few for fine voxels.
  EXPECT_NE(
      refusal(path_of(six, wander(six, random, 20), 256), six, demands_of(Dialect::fanuc)).find("rounding_too_coarse"),
      std::string::npos);
  six.programs.couple_given = false;
  EXPECT_NE(refusal(path, six, demands_of(Dialect::fanuc)).find("\"minus\": \"J2\""), std::string::npos);
  six.programs.axes.pop_back();
  EXPECT_NE(refusal(path, six, demands_of(Dialect::krl)).find("'table' has no axis"), std::string::npos);
}

TEST(Program, CoupledAxesComeBack) {
  Cell cell = shipped_cell("six-axis-turntable");
  cell.programs.couple = {{"A3", "A2"}};
  cell.programs.axes[1].scale = -1;
  cell.programs.axes[1].offset = 0.5;
  const Chain chain = cell.chain();
  const AxisLayout layout = lay_out_axes(cell, chain, Dialect::fanuc);
  Random random(2);
  for (int round = 0; round < 100; ++round) {
    const Configuration q = random_configuration(chain, random), axes = layout.to_axes(q);
    for (Eigen::Index joint = 0; joint < q.size(); ++joint) EXPECT_NEAR(layout.to_joints(axes)[joint], q[joint], 1e-12);
    const auto names = chain.names();
    const auto at = [&](const char* name) { return q[std::ranges::find(names, name) - names.begin()]; };
    EXPECT_NEAR(axes[1], 0.5 - at("a2"), 1e-12);
    EXPECT_NEAR(axes[2], at("a3") - axes[1], 1e-12);
  }
}

}  // namespace
}  // namespace sculpt
