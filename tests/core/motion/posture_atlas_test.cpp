#include "core/motion/posture_atlas.hpp"

#include <gtest/gtest.h>

#include "core/motion/tool/tool_axes.hpp"
#include "tests/core/plan/jobs.hpp"

namespace sculpt {
namespace {

TEST(PostureAtlas, WhatItGivesHoldsTheToolInThePartOrOneBesideIt) {
  const Cell cell = parse_cell(shipped_cell_files("panda-turntable"));
  const Chain chain = cell.chain();
  const Grid grid = cell.grid(16);
  const PostureAtlas atlas(chain, grid, 3);
  std::size_t found = 0;
  for (const Voxel voxel : {Voxel{0, 0, 0}, Voxel{15, 7, 4}, Voxel{8, 8, 15}})
    for (std::size_t axis = 0; axis < atlas.axes().size(); ++axis) {
      const std::vector<Configuration> postures = atlas.around(voxel, axis, 20);
      EXPECT_LE(postures.size(), 20u);
      found += postures.size();
      for (const Configuration& q : postures) {
        EXPECT_TRUE(chain.within_limits(q));
        const ToolPose pose = chain.tool_pose(q);
        EXPECT_LT((pose.axis - tool_axes()[axis]).norm(), 1e-4);
        EXPECT_LT((pose.ball_m - grid.centre(voxel)).cwiseAbs().maxCoeff(), 8 * grid.voxel_m);
      }
    }
  EXPECT_GT(found, 300u);
}

TEST(PostureAtlas, SaysTheSameInAnyOrder) {
  const Cell cell = parse_cell(shipped_cell_files("panda-turntable"));
  const Chain chain = cell.chain();
  const PostureAtlas one(chain, cell.grid(16), 7), other(chain, cell.grid(16), 7);
  other.around({15, 15, 15}, 5, 12);
  other.around({0, 0, 0}, 0, 3);
  EXPECT_EQ(one.around({4, 9, 2}, 0, 12), other.around({4, 9, 2}, 0, 12));
  EXPECT_EQ(one.around({15, 15, 15}, 5, 12), other.around({15, 15, 15}, 5, 12));
}

TEST(PostureAtlas, HasNothingWhereAChainCannotHoldTheTool) {
  const Cell cell = parse_cell(read_cell_files(SOURCE_DIR "/bench/cells_data/cells/scara.json"));
  const Chain chain = cell.chain();
  const PostureAtlas atlas(chain, cell.grid(16), 0);
  const Voxel middle{8, 8, 8};
  EXPECT_FALSE(atlas.around(middle, 0, 3).empty()) << "from above";
  for (std::size_t axis = 1; axis < atlas.axes().size(); ++axis) {
    EXPECT_TRUE(atlas.around(middle, axis, 3).empty()) << axis;
    EXPECT_TRUE(atlas.beyond_limits(middle, axis).empty()) << axis;
  }
}

TEST(PostureAtlas, KnowsWhatJointLimitsForbid) {
  Cell cell = parse_cell(shipped_cell_files("panda-turntable"));
  for (Joint& joint : cell.robot.joints)
    if (joint.name == "joint4") joint.lower = joint.upper - 0.1;  // an arm that cannot bend
  const Chain chain = cell.chain();
  const PostureAtlas atlas(chain, cell.grid(16), 0);
  EXPECT_TRUE(atlas.around({8, 8, 8}, 0, 3).empty());
  EXPECT_FALSE(atlas.beyond_limits({8, 8, 8}, 0).empty());
}

}  // namespace
}  // namespace sculpt
