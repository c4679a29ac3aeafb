#include "core/motion/behind.hpp"

#include <gtest/gtest.h>

#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

/// A block of keep with a shaft down to (8, 8, bottom), one voxel wide.
VoxelSet block_with_shaft(int bottom) {
  VoxelSet keep(16, true);
  for (int k = bottom; k < 16; ++k) keep.erase({8, 8, k});
  return keep;
}

/// The reason of each voxel, given that only `keep` and these, in index order, stand.
std::vector<Reason> look_behind(const VoxelSet& keep, std::vector<Residue> residue,
                                const char* cell_name = "panda-turntable") {
  const Cell cell = parse_cell(shipped_cell_files(cell_name));
  VoxelSet standing = keep;
  for (const Residue& left : residue) standing.insert(left.voxel);
  const Scene scene(cell, cell.grid(keep.n()), standing);
  find_behind(residue, scene, ToolRoom(scene), 2, {});
  std::vector<Reason> reasons;
  for (const Residue& left : residue) reasons.push_back(left.reason);
  return reasons;
}

using enum Reason;
using Reasons = std::vector<Reason>;

TEST(Behind, WhatTheToolCouldComeToWereAnotherVoxelGoneIsBehindThatOne) {
  for (const auto& [reason, behind] :
       {std::pair(out_of_reach, behind_out_of_reach), std::pair(joint_limits, behind_joint_limits),
        std::pair(link_collision, behind_link_collision), std::pair(no_transit, behind_no_transit),
        std::pair(loose_piece, behind_loose_piece)}) {
    SCOPED_TRACE(name(reason));
    EXPECT_EQ(std::string(name(behind)).find("behind voxels left for "), 0u);
    EXPECT_EQ(look_behind(block_with_shaft(3),
                          {{{8, 8, 3}, tool_cannot_reach}, {{8, 8, 4}, tool_cannot_reach}, {{8, 8, 9}, reason}}),
              (Reasons{behind, behind, reason}));
  }
}

TEST(Behind, TheWorstOnTheWayCounts) {
  EXPECT_EQ(look_behind(block_with_shaft(3),
                        {{{8, 8, 3}, tool_cannot_reach}, {{8, 8, 7}, link_collision}, {{8, 8, 9}, no_transit}}),
            (Reasons{behind_link_collision, link_collision, no_transit}));
}

TEST(Behind, OfTwoWaysTheBetterCounts) {
  VoxelSet keep = block_with_shaft(3);
  for (int i = 9; i < 16; ++i) keep.erase({i, 8, 3});
  EXPECT_EQ(look_behind(keep, {{{8, 8, 3}, tool_cannot_reach}, {{12, 8, 3}, loose_piece}, {{8, 8, 7}, link_collision}}),
            (Reasons{behind_loose_piece, loose_piece, link_collision}));
}

TEST(Behind, UnderWhatIsKeptTheToolCannotReachWhateverElseGoes) {
  VoxelSet keep(16, true);
  keep.erase({8, 8, 3});
  for (int k = 3; k < 16; ++k) keep.erase({9, 8, k});
  EXPECT_EQ(look_behind(keep, {{{8, 8, 3}, tool_cannot_reach}, {{9, 8, 9}, no_transit}}),
            (Reasons{tool_cannot_reach, no_transit}));
}

TEST(Behind, WhereTheHolderHasNoRoomTheToolCannotReach) {
  const auto at = [](int bottom) {
    return look_behind(block_with_shaft(bottom), {{{8, 8, bottom}, tool_cannot_reach}, {{8, 8, 13}, joint_limits}},
                       "panda-turntable-6mm");
  };
  EXPECT_EQ(at(4), (Reasons{tool_cannot_reach, joint_limits})) << "144 mm down, the holder ends 80 mm above";
  EXPECT_EQ(at(10), (Reasons{behind_joint_limits, joint_limits})) << "69 mm down";
}

}  // namespace
}  // namespace sculpt
