// The translating robot beside fixtures, and what it leaves standing.
#include <gtest/gtest.h>

#include <sstream>

#include "core/trajectory/header.hpp"
#include "core/trajectory/reader.hpp"
#include "core/trajectory/writer.hpp"
#include "core/verify/verify.hpp"
#include "tests/core/plan/jobs.hpp"
#include "tests/core/plan/soundness.hpp"

namespace sculpt {
namespace {

const std::array<const char*, 2> searches{"voxel", "octree"};

struct Planned {
  JobResult result;
  std::string trajectory;
  std::map<Reason, std::uint64_t> left;
};

Planned plan(Job job, const std::string& search) {
  job.search = parse_search(search);
  const ScratchFile file;
  Planned planned{run_job(job, file.path(), {}), {}, {}};
  planned.trajectory = read_file(file.path());
  planned.left = {planned.result.report.residue.begin(), planned.result.report.residue.end()};
  expect_sound(planned.result);
  return planned;
}

VoxelSet post(int n) {
  VoxelSet target(n);
  for (int k = 0; k < n / 2; ++k) target.insert({n / 2, n / 2, k});
  return target;
}

TEST(GantryPlan, WhatAFixtureKeepsItFromIsResidue) {
  for (const char* search : searches) {
    SCOPED_TRACE(search);
    const Planned planned = plan(make_job(clamped_gantry(), post(16)), search);
    EXPECT_GT(planned.left.at(Reason::link_collision), 100u) << "under the clamp";
    EXPECT_EQ(planned.left.size(), 1u) << "all else can be come to";
  }
}

TEST(GantryPlan, RandomTargetsAndFixturesGiveCleanPlans) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::ostringstream fixtures;
    for (std::uint64_t number = 0; number < 1 + seed % 3; ++number) {
      fixtures << "<collision><origin xyz='" << random.between(-0.15, 0.15) << " " << random.between(-0.15, 0.15) << " "
               << random.between(0, 0.22) << "' rpy='" << random.unit() << " 0 " << random.unit()
               << "'/><geometry><box size='" << random.between(0.0002, 0.1) << " " << random.between(0.01, 0.2) << " "
               << random.between(0.01, 0.2) << "'/></geometry></collision>";
    }
    Job job = make_job(gantry_beside(fixtures.str()), random_target(8, seed), seed);
    job.allow_freed = seed % 4 == 3;
    try {
      plan(job, searches[seed % 2]);
    } catch (const InputError& error) {
      EXPECT_EQ(error.code(), "cell_invalid") << error.what() << ": only a home inside a fixture is refused";
    }
  }
}

TEST(GantryPlan, UnderALidAllIsLeftForWantOfATransit) {
  const Planned planned =
      plan(make_job(gantry_beside("<collision><origin xyz='0 0 0.235'/><geometry><box size='0.6 0.6 "
                                  "0.01'/></geometry></collision>"),
                    post(8)),
           "octree");
  EXPECT_EQ(planned.result.report.voxels.removed, 0u);
  EXPECT_EQ(planned.result.report.path.keyframes, 0u);
  std::map<Reason, std::uint64_t> left = planned.left;
  EXPECT_GT(left[Reason::no_transit], 0u) << "those on the outside";
  EXPECT_EQ(left[Reason::no_transit] + left[Reason::behind_no_transit], planned.result.report.voxels.residue);
}

TEST(GantryPlan, AroundAPlateInTheStraightWayItFindsAnother) {
  const Planned planned =
      plan(make_job(gantry_beside("<collision><origin xyz='-0.05 -0.05 0.235'/><geometry><box size='0.04 0.04 "
                                  "0.005'/></geometry></collision>"),
                    post(8)),
           "octree");
  EXPECT_EQ(planned.result.report.voxels.residue, 0u);
}

TEST(GantryPlan, BeyondItsLimitsIsResidueToo) {
  CellFiles cell = shipped_cell_files("gantry");
  std::string& urdf = cell.files.begin()->second;
  urdf.replace(urdf.find("lower=\"-0.16\""), 13, "lower=\"-0.05\"");
  for (const char* search : searches) {
    const Planned planned = plan(make_job(cell, post(8)), search);
    EXPECT_EQ(planned.left, (std::map<Reason, std::uint64_t>{{Reason::joint_limits, 2 * 8 * 8}}));
  }
}

TEST(GantryPlan, AThickSpindleCutsAsDeepAsItReaches) {
  CellFiles cell = shipped_cell_files("gantry");
  std::string& urdf = cell.files.begin()->second;
  const std::string tool = "<link name=\"tool\"/>";
  urdf.replace(urdf.find(tool), tool.size(),
               "<link name='tool'><collision><origin xyz='0 0 -0.1'/><geometry><cylinder radius='0.02' "
               "length='0.1'/></geometry></collision></link>");
  for (const char* search : searches) {
    SCOPED_TRACE(search);
    const Planned planned = plan(make_job(cell, post(8)), search);
    EXPECT_GT(planned.result.report.voxels.removed, 8u * 8 * 4) << "beside the spindle's way down all is free";
  }
}

TEST(GantryPlan, ItFreesPiecesOnlyWhereThatIsAllowed) {
  VoxelSet roof(16);  // on one post, over all of the stock
  for (int k = 0; k < 16; ++k) roof.insert({8, 8, k});
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 16; ++i) roof.insert({i, j, 8});
  bool any_freed = false;
  for (const char* search : searches) {
    SCOPED_TRACE(search);
    Job job = make_job(shipped_cell_files("gantry"), roof);
    const Planned held = plan(job, search);
    EXPECT_EQ(held.result.report.voxels.freed, 0u);
    EXPECT_NE(held.trajectory.find(R"("held":true)"), std::string::npos);
    job.allow_freed = true;
    const Planned careless = plan(job, search);
    any_freed |= careless.result.report.voxels.freed > 0;
    EXPECT_EQ(careless.result.report.voxels.residue, 0u);
    EXPECT_EQ(careless.trajectory.find("held"), std::string::npos);
  }
  EXPECT_TRUE(any_freed);
}

TEST(GantryPlan, WhatCannotBeClearedOutIsLeftToHoldItsPiece) {
  VoxelSet shell(16);  // in the air, around a hollow that is open below: what cannot be held but for what is in it
  for (int k = 6; k < 14; ++k)
    for (int j = 3; j < 13; ++j)
      for (int i = 3; i < 13; ++i)
        if (k > 11 || i < 5 || i > 10 || j < 5 || j > 10) shell.insert({i, j, k});
  for (const char* search : searches) {
    SCOPED_TRACE(search);
    const Planned planned = plan(make_job(shipped_cell_files("gantry"), shell), search);
    EXPECT_GT(planned.result.report.voxels.loose_keep, 0u);
  }
}

/// The same plan under another header.
std::string with_header(const std::string& trajectory, bool held) {
  std::istringstream in(trajectory);
  TrajectoryReader reader(in);
  TrajectoryHeader header = reader.header();
  header.held = held;
  std::ostringstream out;
  TrajectoryWriter writer(out, header);
  while (const auto keyframe = reader.next()) writer.add(*keyframe);
  writer.finish();
  return out.str();
}

TEST(GantryPlan, AFreedPieceIsAFindingUnlessTheHeaderAllowsIt) {
  VoxelSet roof(8);
  for (int k = 0; k < 8; ++k) roof.insert({4, 4, k});
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 8; ++i) roof.insert({i, j, 4});
  Job job = make_job(shipped_cell_files("gantry"), roof);
  job.allow_freed = true;
  for (const char* search : searches) {
    const Planned planned = plan(job, search);
    if (planned.result.report.voxels.freed == 0) continue;
    const auto verdict = [&](bool held) {
      std::istringstream in(with_header(planned.trajectory, held));
      return verify_trajectory(in, parse_cell(job.cell), planned.result.voxels, {});
    };
    EXPECT_TRUE(verdict(false).clean);
    EXPECT_FALSE(verdict(true).clean);
    return;
  }
  FAIL() << "neither search freed anything: the shape is too easy";
}

}  // namespace
}  // namespace sculpt
