#include "core/place/stand.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

std::string joint_name(const Cell& cell, int joint) {
  return cell.robot.joints[static_cast<std::size_t>(joint)].name;
}

TEST(MovedJoint, ATableIsMovedByTheJointThatTurnsIt) {
  const Cell cell = shipped_cell("panda-turntable");
  EXPECT_EQ(joint_name(cell, find_moved_joint(cell, Moved::table)), "table");
}

TEST(MovedJoint, AStockThatNothingMovesByItsClamp) {
  const Cell cell = shipped_cell("gantry");
  EXPECT_EQ(joint_name(cell, find_moved_joint(cell, Moved::table)), "clamp");
}

TEST(MovedJoint, ABaseIsMovedByTheLastFixedJointBelowTheFirstThatTurns) {
  const Cell cell = shipped_cell("panda-turntable");
  EXPECT_EQ(joint_name(cell, find_moved_joint(cell, Moved::base)), "stand");
}

TEST(MovedJoint, AMachineOfSlidesByItsFirstSlide) {
  const Cell cell = shipped_cell("gantry");
  EXPECT_EQ(joint_name(cell, find_moved_joint(cell, Moved::base)), "x");
}

TEST(MovedJoint, ARobotThatIsTheRootIsRefusedWithTheCure) {
  Cell cell = shipped_cell("panda-turntable");
  // As if the arm stood on nothing: the first joint on the tool's way turns.
  cell.robot.joints[static_cast<std::size_t>(cell.robot.find_joint("joint1"))].parent_link = cell.robot.root;
  try {
    find_moved_joint(cell, Moved::base);
    FAIL() << "found a joint";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "cell_invalid");
    EXPECT_NE(std::string(error.what()).find("joint1"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("move the table"), std::string::npos);
  }
}

TEST(MovedJoint, ByNameOnlyWhereItMovesTheStockAgainstTheTool) {
  const Cell cell = shipped_cell("panda-turntable");
  EXPECT_EQ(joint_name(cell, find_moved_joint(cell, "clamp")), "clamp");
  EXPECT_EQ(joint_name(cell, find_moved_joint(cell, "joint3")), "joint3");
  EXPECT_THROW(find_moved_joint(cell, "no such joint"), InputError);
}

TEST(Stand, TheCellsOwnChangesNothing) {
  const Cell cell = shipped_cell("panda-turntable");
  const int joint = find_moved_joint(cell, Moved::table);
  const Cell same = cell_at(cell, joint, stand_of(cell, joint));
  const Chain chain = cell.chain(), moved = same.chain();
  const Configuration home = cell.home(chain);
  EXPECT_TRUE(chain.tool_pose(home).ball_m.isApprox(moved.tool_pose(home).ball_m, 1e-15));
  EXPECT_EQ(cell.stock_origin_m, same.stock_origin_m);
}

TEST(Stand, TheTableGoesWhereItIsPutAndTurnsAboutItsOwnOrigin) {
  const Cell cell = shipped_cell("panda-turntable");
  const int joint = find_moved_joint(cell, Moved::table);
  Stand stand = stand_of(cell, joint);
  const Vec3 before = cell.chain().tool_pose(cell.home(cell.chain())).ball_m;
  stand.at_m += Vec3(0.1, 0.2, -0.05);
  const Vec3 shifted = cell_at(cell, joint, stand).chain().tool_pose(cell.home(cell.chain())).ball_m;
  EXPECT_TRUE((shifted - (before - Vec3(0.1, 0.2, -0.05))).norm() < 1e-12);
  stand.turn_rad = 0.5;
  const Vec3 turned = cell_at(cell, joint, stand).chain().tool_pose(cell.home(cell.chain())).ball_m;
  EXPECT_TRUE((turned - Eigen::AngleAxisd(-0.5, Vec3::UnitZ()) * shifted).norm() < 1e-12);
}

TEST(Stand, AToolThatIsNoLongerThanItsHolderIsRefused) {
  const Cell cell = shipped_cell("panda-turntable-6mm");
  const int joint = find_moved_joint(cell, Moved::table);
  Stand stand = stand_of(cell, joint);
  stand.stickout_m = 0.08;
  EXPECT_THROW(cell_at(cell, joint, stand), InputError);
}

}  // namespace
}  // namespace sculpt
