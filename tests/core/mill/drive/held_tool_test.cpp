#include "core/mill/drive/held_tool.hpp"

#include <gtest/gtest.h>

#include "core/mill/drive/reach_floor.hpp"
#include "core/mill/map/fixtures.hpp"
#include "tests/core/material/shapes.hpp"
#include "tests/core/mill/drive/held_d6.hpp"

namespace sculpt {
namespace {

using HeldToolTest = HeldD6;

// Found once: of (26, 0, -15) there was none, of (-26, 0, -15) three quarters of all, although the table turns.
TEST_F(HeldToolTest, ADirectionIsHeldAsItsQuarterTurnsAreWhereTheStockCanBeTurned) {
  for (Direction direction : {Direction{1, 0, 0}, {26, 0, -15}, {18, 18, -15}}) {
    const std::size_t first = fields(direction).front()->usable_cells();
    EXPECT_GT(2 * first, PostureField::all_cells()) << direction[0] << " " << direction[1] << " " << direction[2];
    const Configuration q = fields(direction).front()->start();
    for (int quarter = 0; quarter < 4; ++quarter, direction = {-direction[1], direction[0], direction[2]}) {
      const HeldTool::Fields& turned = fields(direction);
      ASSERT_FALSE(turned.empty());
      EXPECT_EQ(turned.front()->usable_cells(), first);
      EXPECT_NEAR(turned.front()->view().axis().dot(Vec3(direction[0], direction[1], direction[2]).normalized()), 1,
                  1e-12);
      const ToolPose pose = turned.front()->chain().tool_pose(turned.front()->start());
      EXPECT_NEAR(pose.axis.dot(turned.front()->view().axis()), 1, 1e-6) << "the arm holds it so";
      EXPECT_EQ((turned.front()->start() - q).cwiseAbs().array().count(), quarter == 0 ? 0 : 1) << "the table alone";
    }
  }
}

TEST_F(HeldToolTest, WhereTheTableTurnsLittleEachDirectionIsLookedForOnItsOwn) {
  Cell stiff = cell;
  for (Joint& joint : stiff.robot.joints)
    if (joint.name == "table") {
      joint.lower = -0.5;
      joint.upper = 0.5;
    }
  HeldTool here(stiff, tool, grid, around);
  int directions_held = 0;
  for (const Direction& direction : {Direction{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}})
    directions_held += !here.fields(direction, home, {0, helpers, watch}).empty();
  EXPECT_GE(directions_held, 3);
}

// Along a tilted axis what is above the stock may be outside of the field.
TEST_F(HeldToolTest, WhereTheTipIsAllowedTheFieldBegins) {
  const Direction direction{18, 18, -15};
  const ToolFrame frame(direction);
  const Vec3 high = grid.origin_m + Vec3::Constant(n * grid.voxel_m);
  const Site site(frame, lattice_over(frame, grid.origin_m, high, room_m, 2e-3), held.assembly(),
                  shapes::box(grid.origin_m, high), fixture_mesh(cell), {1e-4, 1e-4});
  const PostureField& field = *fields(direction).front();
  double top = 0;
  for (int corner = 0; corner < 8; ++corner)
    top =
        std::max(top, frame.of(grid.origin_m + n * grid.voxel_m * Vec3(corner & 1, corner >> 1 & 1, corner >> 2)).z());
  const ReachFloor reach(field, around, site, top + 0.05, helpers);
  const Lattice& lattice = site.lattice();
  int allowed = 0, wrong = 0, outside = 0;
  for (int b = 0; b < lattice.height; b += 3)
    for (int a = 0; a < lattice.width; a += 3)
      for (double down = 0; down < 0.3; down += 0.02) {
        const Vec3 tip(lattice.u(a), lattice.v(b), top + 0.05 - down);
        const Vec3 at = HeldTool::cell_of(field, around, frame.point(tip));
        const bool is_outside = (at.array() < -1.5).any() || (at.array() > around.n + 0.5).any();
        outside += is_outside;
        if (!reach.allows(tip)) continue;
        ++allowed;
        wrong += is_outside;
      }
  EXPECT_GT(allowed, 100);
  EXPECT_GT(outside, 100);
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace sculpt
