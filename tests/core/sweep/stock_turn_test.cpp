#include "core/sweep/stock_turn.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/sweep/field/find_field.hpp"
#include "tests/core/cell/sample_robots.hpp"
#include "tests/core/sweep/clamped_cell.hpp"

namespace sculpt {
namespace {

TEST(StockTurn, IsTheTableUnderTheShippedArm) {
  const Cell cell = shipped_cell("panda-turntable");
  const Chain chain = cell.chain();
  const auto turn = find_stock_turn(chain, cell.grid(16));
  ASSERT_TRUE(turn);
  EXPECT_EQ(chain.names()[static_cast<std::size_t>(turn->coordinate)], "table");
}

TEST(StockTurn, IsNoneWhereSomethingStandsBesideTheStockOrTheStockIsOffTheMiddle) {
  const Cell clamped = parse_cell(clamped_cell());
  EXPECT_FALSE(find_stock_turn(clamped.chain(), clamped.grid(16)));
  const Cell cell = shipped_cell("panda-turntable");
  Grid grid = cell.grid(16);
  grid.origin_m.x() += 0.001;
  EXPECT_FALSE(find_stock_turn(cell.chain(), grid));
}

TEST(StockTurn, TurnsAFieldIntoOneOfAnotherSide) {
  const Cell cell = shipped_cell("panda-turntable");
  const Grid grid = cell.grid(16);
  const Scene scene(cell, grid, VoxelSet(16, true)), empty(cell, grid, VoxelSet(16));
  const Chain& chain = scene.chain();
  const auto turn = find_stock_turn(chain, grid);
  ASSERT_TRUE(turn);
  const auto views = tool_views(16);
  const auto fields = find_fields(scene, views[1], cell.home(chain), {}, {1, 1, {}});
  const PostureField* side = fields.front().get();
  for (int quarters : {1, 2, 3}) {
    double by = turn->direction * quarters * std::numbers::pi / 2;
    if (!side->can_turn(turn->coordinate, by)) by -= turn->direction * 2 * std::numbers::pi;
    ASSERT_TRUE(side->can_turn(turn->coordinate, by));
    const PostureField other(*side, views[static_cast<std::size_t>(1 + quarters)],
                             by * Configuration::Unit(chain.dof(), turn->coordinate));
    EXPECT_EQ(other.usable_cells(), side->usable_cells());
    Random random(static_cast<std::uint64_t>(quarters));
    int free = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const Vec3 from(random.between(0, 15), random.between(0, 15), random.between(1, 17));
      const Vec3 to = from + Vec3(random.between(-0.5, 0.5), random.between(-0.5, 0.5), 0);
      SCOPED_TRACE(::testing::Message() << quarters << " quarters, trial " << trial);
      if ((to.array() < 0).any() || (to.head<2>().array() > 15).any()) continue;
      const auto q = other.at(from), r = other.at(to);
      if (!q || !r) continue;
      const ToolPose pose = chain.tool_pose(*q);
      ASSERT_LT((pose.ball_m - other.ball_m(from)).norm(), 1e-6);
      ASSERT_LT((pose.axis - other.view().axis()).norm(), 1e-5);
      int held = -1;
      if (!other.links_are_free(from, *q, to, *r, held)) continue;
      ++free;
      ASSERT_EQ(empty.certify(*q, *r), Contact::none);
    }
    EXPECT_GT(free, 150);
  }
}

}  // namespace
}  // namespace sculpt
