#include "core/doctor/find_home.hpp"

#include <gtest/gtest.h>

#include "tests/core/cell/sample_robots.hpp"
#include "tests/core/doctor/doctor_cells.hpp"

namespace sculpt {
namespace {

std::optional<Home> home_of(const Cell& cell, std::uint64_t seed, int threads = 2) {
  const QuietRun run(threads);
  const Grid grid = cell.grid(16);
  const Scene scene(cell, grid, VoxelSet(grid.n, true));
  return find_home(scene, Configuration::Zero(scene.chain().dof()), run.context(seed));
}

TEST(FindHome, IsFreeUprightAboveTheMiddleAndAwayFromThings) {
  for (const char* name : {"panda-turntable", "panda-turntable-6mm", "gantry"}) {
    const Cell cell = shipped_cell(name);
    const auto home = home_of(cell, 0);
    ASSERT_TRUE(home) << name;
    const Grid grid = cell.grid(16);
    const Scene scene(cell, grid, VoxelSet(grid.n, true));
    EXPECT_EQ(scene.contact_at(home->q), Contact::none) << name;
    const ToolPose pose = scene.chain().tool_pose(home->q);
    EXPECT_TRUE(pose.axis.isApprox(Vec3::UnitZ(), 1e-3)) << name;
    EXPECT_GT(pose.ball_m.z(), grid.origin_m.z() + cell.stock_size_m) << name;
    EXPECT_NEAR(pose.ball_m.x(), grid.origin_m.x() + cell.stock_size_m / 2, 1e-3) << name;
    EXPECT_TRUE(home->reach == 1 || !cell.tool.holder.empty()) << name << ' ' << home->reach;
  }
}

TEST(FindHome, IsTheSameForASeedOnAnyNumberOfThreads) {
  const Cell cell = shipped_cell("panda-turntable");
  EXPECT_EQ(home_of(cell, 5, 1)->q, home_of(cell, 5, 4)->q);
}

TEST(FindHome, IsNothingWhereTheArmCannotBe) {
  Cell cell = shipped_cell("panda-turntable");
  cell.stock_origin_m.z() = 3;
  EXPECT_FALSE(home_of(cell, 0));
}

}  // namespace
}  // namespace sculpt
