#include "core/motion/residue.hpp"

#include <gtest/gtest.h>

#include "core/motion/explain_residue.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

/// Residue of a scene in which only the stock of `voxels` is left.
std::vector<Residue> explain(const Cell& cell, const VoxelGrid& voxels) {
  const Scene scene(cell, cell.grid(voxels.n()), voxels.stock);
  const PostureAtlas atlas(scene.chain(), scene.grid(), 0);
  return explain_residue(scene, atlas, voxels, find_unheld(voxels), {0, 2, {}});
}

std::vector<Residue> explain(const Cell& cell, const VoxelSet& keep, Voxel left) {
  VoxelSet standing = keep;
  standing.insert(left);
  return explain(cell, {standing, keep});
}

TEST(Residue, AVoxelInTheOpenThatWasLeftLacksATransit) {
  const auto residue = explain(parse_cell(shipped_cell_files("panda-turntable")), VoxelSet(8), {4, 4, 4});
  ASSERT_EQ(residue.size(), 1u);
  EXPECT_EQ(residue[0].voxel, (Voxel{4, 4, 4}));
  EXPECT_EQ(residue[0].reason, Reason::no_transit);
}

TEST(Residue, UnderARoofTheToolCannotReach) {
  VoxelSet keep(8, true);
  keep.erase({4, 4, 0});
  keep.erase({4, 4, 1});
  keep.erase({4, 5, 1});
  for (int k = 1; k < 8; ++k) keep.erase({4, 5, k});
  const auto residue = explain(parse_cell(shipped_cell_files("panda-turntable")), keep, {4, 4, 0});
  ASSERT_EQ(residue.size(), 1u);
  EXPECT_EQ(residue[0].reason, Reason::tool_cannot_reach);
}

TEST(Residue, DownADeepShaftOnlyAToolWithoutHolderReaches) {
  const auto reason_at = [](const char* cell, int bottom) {
    VoxelSet keep(16, true);
    for (int k = bottom; k < 16; ++k) keep.erase({8, 8, k});
    const auto residue = explain(parse_cell(shipped_cell_files(cell)), keep, {8, 8, bottom});
    return residue.size() == 1 ? name(residue[0].reason) : "none";
  };
  EXPECT_STREQ(reason_at("panda-turntable", 4), "no transit");
  EXPECT_STREQ(reason_at("panda-turntable-6mm", 4), "tool cannot reach") << "144 mm down, the holder ends 80 mm above";
  EXPECT_STREQ(reason_at("panda-turntable-6mm", 10), "no transit") << "69 mm down";
}

TEST(Residue, BelowAVoxelThatWasLeftForReachTheToolIsNotToBlame) {
  CellFiles files = shipped_cell_files("panda-turntable");
  const std::string at = "\"origin_m\": [-0.1, -0.1, 0]";
  files.cell_json.replace(files.cell_json.find(at), at.size(), "\"origin_m\": [-0.1, -0.1, 4]");
  VoxelSet keep(8, true);
  for (int k = 2; k < 8; ++k) keep.erase({4, 4, k});
  VoxelSet standing = keep;
  standing.insert({4, 4, 2});
  standing.insert({4, 4, 5});
  const Cell cell = parse_cell(files);
  const auto residue = explain(cell, {standing, keep});
  ASSERT_EQ(residue.size(), 2u);
  EXPECT_EQ(residue[0].reason, Reason::behind_out_of_reach);
  EXPECT_EQ(residue[1].reason, Reason::out_of_reach);
}

TEST(Residue, ShutInIsEnclosed) {
  VoxelSet keep(8, true);
  keep.erase({4, 4, 4});
  const auto residue = explain(parse_cell(shipped_cell_files("panda-turntable")), keep, {4, 4, 4});
  ASSERT_EQ(residue.size(), 1u);
  EXPECT_EQ(residue[0].reason, Reason::enclosed);
}

TEST(Residue, FarAwayIsOutOfReachAndBehindALimitIsAJointLimit) {
  CellFiles files = shipped_cell_files("panda-turntable");
  const std::string at = "\"origin_m\": [-0.1, -0.1, 0]";
  files.cell_json.replace(files.cell_json.find(at), at.size(), "\"origin_m\": [-0.1, -0.1, 4]");
  const auto far = explain(parse_cell(files), VoxelSet(8), {4, 4, 4});
  ASSERT_EQ(far.size(), 1u);
  EXPECT_EQ(far[0].reason, Reason::out_of_reach);

  Cell cell = parse_cell(shipped_cell_files("panda-turntable"));
  const auto limit = [&](const char* name, double lower, double upper) {
    Joint& joint = cell.robot.joints[static_cast<std::size_t>(cell.robot.find_joint(name))];
    joint.lower = lower;
    joint.upper = upper;
  };
  limit("joint1", -0.1, 0.1);
  limit("joint2", -1.7, -1.6);
  limit("joint3", -0.1, 0.1);
  const auto limited = explain(cell, VoxelSet(8), {4, 4, 4});
  ASSERT_EQ(limited.size(), 1u);
  EXPECT_EQ(limited[0].reason, Reason::joint_limits);
}

}  // namespace
}  // namespace sculpt
