#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/cell/ik.hpp"
#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

TEST(ShippedCells, HomeIsWithinLimitsWithTheToolPointingDownAboveTheStock) {
  for (const char* name : {"panda-turntable", "panda-turntable-6mm", "gantry"}) {
    SCOPED_TRACE(name);
    const Cell cell = shipped_cell(name);
    const Chain chain = cell.chain();
    const Configuration home = cell.home(chain);
    EXPECT_TRUE(chain.within_limits(home, 0));
    const ToolPose pose = chain.tool_pose(home);
    EXPECT_NEAR(pose.axis.z(), 1, 1e-9);
    EXPECT_GT(pose.ball_m.z(), cell.stock_origin_m.z() + cell.stock_size_m + 0.04);
  }
}

TEST(ShippedCells, PandaHomeIsWhereTheDocumentationSays) {
  const Cell cell = shipped_cell("panda-turntable");
  const Chain chain = cell.chain();
  EXPECT_LT((chain.tool_pose(cell.home(chain)).ball_m - Vec3(-0.1, 0, 0.26)).norm(), 1e-4);
}

TEST(ShippedCells, GantryCoordinatesAreTheBallInTheStockFrame) {
  const Cell cell = shipped_cell("gantry");
  const Chain chain = cell.chain();
  EXPECT_TRUE(chain.translating());
  EXPECT_LT((chain.tool_pose(Eigen::Vector3d(0.01, 0.02, 0.03)).ball_m - Vec3(0.01, 0.02, 0.03)).norm(), 1e-15);
  const Grid coarse = cell.grid(8);
  EXPECT_TRUE(chain.within_limits(coarse.centre({-1, -1, 0}))) << "one voxel beside the coarsest grid";
  EXPECT_TRUE(chain.within_limits(coarse.centre({8, 8, 8}))) << "and above it";
}

TEST(ShippedCells, FloorOfTheGantryEndsExactlyAtTheStock) {
  const Cell cell = shipped_cell("gantry");
  const Shape& floor = cell.robot.links[static_cast<std::size_t>(cell.robot.find_link("room"))].shapes.at(0);
  EXPECT_EQ(floor.pose.translation().z() + floor.sides_m.z() / 2, cell.stock_origin_m.z());
}

TEST(ShippedCells, PandaReachesEveryCornerOfTheStockInFiveDirections) {
  const Cell cell = shipped_cell("panda-turntable");
  const Chain chain = cell.chain();
  const Grid grid = cell.grid(8);
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
    for (int corner = 0; corner < 8; ++corner) {
      const Voxel voxel{corner & 1 ? 7 : 0, corner & 2 ? 7 : 0, corner & 4 ? 7 : 0};
      SCOPED_TRACE(testing::Message() << axis.transpose() << " corner " << corner);
      bool reached = false;
      for (std::uint64_t seed = 0; seed < 30 && !reached; ++seed) {
        Random random(seed);
        reached = solve_ik(chain, {grid.centre(voxel), axis}, random_configuration(chain, random, 0.2)).has_value();
      }
      EXPECT_TRUE(reached);
    }
  }
}

}  // namespace
}  // namespace sculpt
