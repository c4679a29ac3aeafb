#include "core/verify/verify.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/trajectory/header.hpp"
#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

VoxelGrid full_block(int n) {
  return {VoxelSet(n, true), VoxelSet(n)};
}

TEST(Verify, CountsWhatATranslatingRobotFrees) {
  const Cell cell = gantry_cell();
  VoxelGrid voxels{VoxelSet(8), VoxelSet(8)};
  for (int k = 0; k < 8; ++k) voxels.stock.insert({1, 1, k});
  for (int i = 2; i < 6; ++i) voxels.stock.insert({i, 1, 5});
  GantryProgram program(cell, 8);
  program.plunge(1, 1, 4);
  program.go_home();
  const Verdict verdict = verify_text(program.text(), cell, voxels);
  EXPECT_TRUE(verdict.clean) << sentences(verdict);
  EXPECT_EQ(verdict.freed, 4u);

  program.header().held = true;
  const Verdict held = verify_text(program.text(), cell, voxels);
  EXPECT_FALSE(held.clean);
  EXPECT_TRUE(found(held, {"(1, 1, 5)", "4 voxels", "come loose"})) << sentences(held);
}

TEST(Verify, LandscapesCarvedColumnByColumnAreClean) {
  const Cell cell = gantry_cell();
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Landscape land = random_landscape(8, random);
    const Verdict verdict = verify_text(carve_landscape(cell, land).text(), cell, land.voxels);
    EXPECT_TRUE(verdict.clean) << sentences(verdict);
    EXPECT_EQ(verdict.voxels_checked, 512 - land.voxels.keep.size());
    EXPECT_EQ(verdict.left, land.voxels.keep);
  }
}

TEST(Verify, ABlockCarvedLayerByLayerToTheTableIsClean) {
  const Cell cell = gantry_cell();
  GantryProgram program(cell, 8);
  program.move(Vec3(-0.5, 0.5, 9));
  for (int k = 7; k >= 0; --k) {
    program.move(Vec3(-0.5, 0.5, k + 0.5));
    for (int j = 0; j < 8; ++j) {
      program.move(Vec3(j % 2 == 0 ? -0.5 : 8.5, j + 0.5, k + 0.5));
      program.cut({j % 2 == 0 ? 0 : 7, j, k}, {j % 2 == 0 ? 7 : 0, j, k});
      program.move(Vec3(j % 2 == 0 ? 8.5 : -0.5, j + 0.5, k + 0.5));
    }
  }
  program.move(Vec3(-0.5, 7.5, 9));
  program.go_home();
  const Verdict verdict = verify_text(program.text(), cell, full_block(8));
  EXPECT_TRUE(verdict.clean) << sentences(verdict);
  EXPECT_EQ(verdict.left.size(), 0u);
}

TEST(Verify, AnEmptyTrajectoryIsCleanAndLeavesAll) {
  const Cell cell = gantry_cell();
  const Verdict verdict = verify_text(GantryProgram(cell, 8).text(), cell, full_block(8));
  EXPECT_TRUE(verdict.clean) << sentences(verdict);
  EXPECT_EQ(verdict.left.size(), 512u);
}

TEST(Verify, TextThatIsNoTrajectoryIsRefused) {
  const Cell cell = gantry_cell();
  const std::string text = GantryProgram(cell, 8).text();
  EXPECT_THROW(verify_text("", cell, full_block(8)), InputError);
  EXPECT_THROW(verify_text(text.substr(0, text.size() / 2), cell, full_block(8)), InputError);
  EXPECT_THROW(verify_text(text.substr(0, text.find('\n') + 1), cell, full_block(8)), InputError);
  EXPECT_THROW(verify_text(text.substr(0, text.find('\n') + 1), cell, full_block(16)), InputError);
}

TEST(Verify, StopsWhenAsked) {
  const Cell cell = gantry_cell();
  Random random(1);
  const Landscape land = random_landscape(8, random);
  std::stop_source source;
  int told = 0;
  const Watch watch{source.get_token(), [&](const Progress& progress) {
                      EXPECT_EQ(progress.stage, Stage::verify);
                      EXPECT_LE(progress.done, progress.total);
                      if (++told == 10) source.request_stop();
                    }};
  std::istringstream in(carve_landscape(cell, land).text());
  EXPECT_THROW(verify_trajectory(in, cell, land.voxels, watch), Cancelled);
  EXPECT_EQ(told, 10);
}

TEST(Verify, TheHeaderMustAgreeWithTheCell) {
  const Cell cell = gantry_cell();
  const auto verdict_with = [&](const std::function<void(TrajectoryHeader&)>& change) {
    GantryProgram program(cell, 8);
    change(program.header());
    program.go_home();
    return verify_text(program.text(), cell, full_block(8));
  };
  EXPECT_TRUE(verdict_with([](TrajectoryHeader&) {}).clean);
  EXPECT_TRUE(found(verdict_with([](TrajectoryHeader& h) { h.joints = {"x", "z", "y"}; }), {"joints"}));
  EXPECT_TRUE(found(verdict_with([](TrajectoryHeader& h) { h.joints = {"a", "b", "c"}; }), {"joints"}));
  EXPECT_TRUE(found(verdict_with([](TrajectoryHeader& h) { h.grid.n = 16; }), {"resolution"}));
  EXPECT_TRUE(found(verdict_with([](TrajectoryHeader& h) { h.grid.voxel_m *= 1.001; }), {"voxel size"}));
  EXPECT_TRUE(found(verdict_with([](TrajectoryHeader& h) { h.grid.origin_m.x() += 1e-6; }), {"origin"}));
  EXPECT_TRUE(found(verdict_with([](TrajectoryHeader& h) { h.tool.ball_radius_m *= 0.99; }), {"tool"}));
  EXPECT_TRUE(found(verdict_with([](TrajectoryHeader& h) { h.tool.shank_radius_m = 0; }), {"tool"}));
  EXPECT_TRUE(found(verdict_with([](TrajectoryHeader& h) { h.tool.stickout_m += 1e-6; }), {"tool"}));
  EXPECT_TRUE(found(verdict_with([](TrajectoryHeader& h) { h.tolerance_m = 0.05 * h.grid.voxel_m; }), {"tolerance"}));
  EXPECT_TRUE(found(verdict_with([](TrajectoryHeader& h) { h.home[1] += 0.01; }), {"home", "y"}));
}

TEST(Verify, OnlyTheFirstHundredFindingsAreListedButAllAreCounted) {
  const Cell cell = gantry_cell();
  GantryProgram program(cell, 8);
  program.move(Vec3(0.5, 0.5, 8.5));
  for (int repeat = 0; repeat < 150; ++repeat) {
    program.cut({0, 0, 7}, {0, 0, 7});
    program.move(Vec3(0.5, 0.5, 8.5));
  }
  program.go_home();
  const Verdict verdict = verify_text(program.text(), cell, full_block(8));
  EXPECT_EQ(verdict.collisions, 149u);
  EXPECT_EQ(verdict.findings.size(), 100u);
  EXPECT_EQ(verdict.findings[0].line, 5u);
}

TEST(Verify, TheToolMayPassAWallAtAThirtiethOfAVoxelButNotScrapeIt) {
  const Cell cell = gantry_cell();
  for (const auto& [aside, clean] : {std::pair{0.03, true}, {0.045, true}, {0.055, false}, {0.2, false}}) {
    GantryProgram program(cell, 8);
    program.move(Vec3(3.5, 3.5, 8.5));
    program.cut({3, 3, 7}, {3, 3, 3});
    program.move(Vec3(3.5 + aside, 3.5, 5.5));
    program.move(Vec3(3.5, 3.5, 8.5));
    program.go_home();
    const Verdict verdict = verify_text(program.text(), cell, full_block(8));
    EXPECT_EQ(verdict.clean, clean) << aside << "\n" << sentences(verdict);
    if (!clean) {
      EXPECT_TRUE(found(verdict, {"ball", "material"})) << sentences(verdict);
    }
  }
}

TEST(Verify, AShankThroughMaterialAboveIsFound) {
  const Cell cell = gantry_cell();
  GantryProgram program(cell, 8);
  program.move(Vec3(-0.5, 3.5, 8.5));
  program.move(Vec3(-0.5, 3.5, 2.5));
  program.cut({0, 3, 2}, {1, 3, 2});
  program.move(Vec3(-0.5, 3.5, 2.5));
  program.move(Vec3(-0.5, 3.5, 8.5));
  program.go_home();
  const Verdict verdict = verify_text(program.text(), cell, full_block(8));
  EXPECT_FALSE(verdict.clean);
  EXPECT_TRUE(found(verdict, {"shank", "material"})) << sentences(verdict);
  EXPECT_FALSE(found(verdict, {"ball"})) << sentences(verdict);
}

TEST(Verify, ASpindleThatReachesTheMaterialIsFound) {
  Cell cell = gantry_cell();
  cell.tool.stickout_m = 0.05;
  for (Joint& joint : cell.robot.joints)
    if (joint.name == "z") joint.origin.translation().z() = 0.05;
  for (const auto& [lowest, clean] : {std::pair{4, true}, {3, true}, {2, false}}) {
    GantryProgram program(cell, 8);
    program.plunge(3, 3, lowest);
    program.go_home();
    const Verdict verdict = verify_text(program.text(), cell, full_block(8));
    EXPECT_EQ(verdict.clean, clean) << lowest << "\n" << sentences(verdict);
    if (!clean) {
      EXPECT_TRUE(found(verdict, {"spindle", "material"})) << sentences(verdict);
    }
  }
}

}  // namespace
}  // namespace sculpt
