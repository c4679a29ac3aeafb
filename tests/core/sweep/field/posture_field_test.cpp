#include "core/sweep/field/posture_field.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/sweep/field/find_field.hpp"
#include "tests/core/sweep/clamped_cell.hpp"
#include "tests/core/sweep/panda_field.hpp"

namespace sculpt {
namespace {

constexpr double top = 17.4;  // cells: half a voxel below the top of the lattice

Vec3 random_cell(Random& random) {
  return {random.between(0, 15), random.between(0, 15), random.between(0, top)};
}

TEST(PostureField, CoversMostOfTheGrid) {
  const PostureField& field = PandaField::get().field;
  EXPECT_GT(field.usable_cells(), PostureField::all_cells() * 3 / 4);
}

TEST(PostureField, HasTheBallWhereItSaysWithTheToolAlongTheDirection) {
  const PostureField& field = PandaField::get().field;
  Random random(1);
  int found = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vec3 cell = random_cell(random);
    SCOPED_TRACE(::testing::Message() << "trial " << trial << ", cell " << cell.transpose());
    const auto q = field.at(cell);
    if (!q) continue;
    ++found;
    ASSERT_TRUE(field.usable(cell));
    ASSERT_TRUE(field.chain().within_limits(*q));
    const ToolPose pose = field.chain().tool_pose(*q);
    ASSERT_LT((pose.ball_m - field.ball_m(cell)).norm(), 1e-6);
    ASSERT_LT(pose.axis.cross(field.view().axis()).norm(), 1e-5);
    ASSERT_GT(pose.axis.dot(field.view().axis()), 0);
  }
  EXPECT_GT(found, 2000);
}

// What it turned by then was read from memory that nobody had written.
TEST(PostureField, OfWhichNothingCanBeReachedTurnsNowhere) {
  const Cell& cell = PandaField::get().cell;
  Grid far = cell.grid(16);
  far.origin_m += Vec3(100, 0, 0);
  const Scene scene(cell, far, VoxelSet(16, true));
  const PostureField field(scene, tool_views(16)[0], PostureLattice::Start{cell.home(scene.chain())}, 1, {});
  EXPECT_EQ(field.usable_cells(), 0u);
  for (int coordinate = 0; coordinate < scene.chain().dof(); ++coordinate)
    for (const double by : {-1e-3, 0.0, 1e-3}) EXPECT_FALSE(field.can_turn(coordinate, by));
}

// It was grown from home, with the ball where it should be and the tool along another direction, and said to be usable.
TEST(PostureField, OfADirectionThatTheChainCannotHoldIsUsableNowhere) {
  const Cell scara = parse_cell(read_cell_files(SOURCE_DIR "/bench/cells_data/cells/scara.json"));
  const Scene scene(scara, scara.grid(16), VoxelSet(16, true));
  const Configuration home = scara.home(scene.chain());
  EXPECT_EQ(make_field(scene, home, tool_views(16)[0]).usable_cells(), PostureField::all_cells());
  std::vector<ToolView> views;
  for (const ToolView& view : tool_views(16)) views.push_back(view);
  for (const ToolView& view : tilted_views(16)) views.push_back(view);
  for (std::size_t view = 1; view < views.size(); ++view)
    for (const auto& field : find_fields(scene, views[view], home, {}, {view, 1, {}}))
      EXPECT_EQ(field->usable_cells(), 0u) << views[view].axis().transpose();
}

TEST(PostureField, IsAsGoodForAGridThatNeedsMoreNodes) {
  const Cell& cell = PandaField::get().cell;
  const Grid grid = cell.grid(64);
  const Scene scene(cell, grid, VoxelSet(64, true));
  const PostureField field = make_field(scene, cell.home(scene.chain()), tool_views(64)[0]);
  EXPECT_GT(field.usable_cells(), PostureField::all_cells() * 3 / 4);
  Random random(7);
  int found = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 at(random.between(0, 63), random.between(0, 63), random.between(0, 65));
    const auto q = field.at(at);
    ASSERT_EQ(q.has_value(), field.usable(at)) << at.transpose();
    if (!q) continue;
    ++found;
    ASSERT_LT((*q - field.guess(at)).cwiseAbs().maxCoeff(), 0.02) << at.transpose();
    ASSERT_LT((scene.chain().tool_pose(*q).ball_m - field.ball_m(at)).norm(), 1e-6) << at.transpose();
  }
  EXPECT_GT(found, 700);
}

// The hub was where the lattice grew from, usable or not, and a direction of which it was not was not cut along at all.
TEST(PostureField, HasItsHubAndItsWaysWhereItIsUsable) {
  const Cell cell = parse_cell(
      cell_with("<collision><origin xyz='0 0 0.24'/><geometry><box size='0.02 0.12 0.06'/></geometry></collision>"));
  const Scene scene(cell, cell.grid(16), VoxelSet(16, true));
  const PostureField field = make_field(scene, cell.home(scene.chain()), tool_views(16)[0]);
  const Vec3 middle(8, 8, 17), hub = ToolView::place(field.hub());
  ASSERT_FALSE(field.usable(middle));
  EXPECT_TRUE(field.usable(hub));
  EXPECT_LT((hub - middle).norm(), 5);
  EXPECT_TRUE(field.at(hub));
  int around = 0;
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    Vec3 at(random.between(0, 15), random.between(0, 15), 17);
    const Vec3 to(random.between(0, 15), random.between(0, 15), 17);
    if (!field.usable(at) || !field.usable(to)) continue;
    const std::vector<Vec3> way = field.way_over(at, to);
    ASSERT_FALSE(way.empty());
    EXPECT_EQ(way.back(), to);
    around += way.size() > 1;
    for (const Vec3& next : way) {
      for (int part = 0; part <= 100; ++part)
        ASSERT_TRUE(field.usable(at + part / 100.0 * (next - at))) << "trial " << trial;
      at = next;
    }
  }
  EXPECT_GT(around, 20);
}

TEST(PostureField, NeighbouringPositionsHaveNeighbouringConfigurations) {
  const PostureField& field = PandaField::get().field;
  Random random(2);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 cell = random_cell(random), beside = cell + Vec3(1e-3, -1e-3, 1e-3);
    SCOPED_TRACE(::testing::Message() << "trial " << trial << ", cell " << cell.transpose());
    const auto q = field.at(cell), r = field.at(beside);
    if (!q || !r) continue;
    ASSERT_LT((*q - *r).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST(PostureField, WhatCanBeComeToCanBeLeftUpwards) {
  const PostureField& field = PandaField::get().field;
  for (int b = 0; b < 16; ++b)
    for (int a = 0; a < 16; ++a)
      for (double c = 0; c + 0.25 < top; c += 0.25)
        ASSERT_TRUE(!field.usable(Vec3(a, b, c)) || field.usable(Vec3(a, b, c + 0.25))) << a << ' ' << b << ' ' << c;
}

TEST(PostureField, OfATiltedDirectionReachesPastTheSidesThatItLeansTo) {
  const PandaField& panda = PandaField::get();
  const Configuration home = panda.cell.home(panda.scene.chain());
  for (std::size_t which : {0u, 4u}) {
    const ToolView view = tilted_views(16)[which];
    SCOPED_TRACE(::testing::Message() << "axis " << view.axis().transpose());
    const auto fields = find_fields(panda.scene, view, home, {panda.field.start()}, {which, 1, {}});
    const PostureField* field = fields.front().get();
    EXPECT_GT(field->usable_cells(), PostureField::all_cells() * 3 / 4);
    const Vec3 lean(view.lean.i, view.lean.j, view.lean.k), last = Vec3::Constant(15) + 2 * lean;
    Random random(which);
    int beyond = 0;
    for (int trial = 0; trial < 1000; ++trial) {
      Vec3 cell;
      for (int axis = 0; axis < 3; ++axis) cell[axis] = random.between(0, last[axis]);
      SCOPED_TRACE(::testing::Message() << "trial " << trial << ", cell " << cell.transpose());
      const auto q = field->at(cell);
      if (!q) continue;
      beyond += (cell.array() > 15.5).any();
      const ToolPose pose = field->chain().tool_pose(*q);
      ASSERT_LT((pose.ball_m - field->ball_m(cell)).norm(), 1e-6);
      ASSERT_LT((pose.axis - view.axis()).norm(), 1e-5);
      for (Vec3 out = cell; (out.array() <= last.array()).all(); out += 0.1 * lean) ASSERT_TRUE(field->usable(out));
    }
    EXPECT_GT(beyond, 100);
  }
}

/// Ball and shank for ball positions between two cells, off by `tolerance` voxel edges on all sides.
bool tool_is_clear(const Scene& scene, const PostureField& field, const Vec3& from, const Vec3& to, double tolerance) {
  const Tool& tool = scene.tool();
  const Vec3 a = field.ball_m(from), b = field.ball_m(to), reach = tool.stickout_m * field.view().axis();
  const Vec3 around = Vec3::Constant(tool.ball_radius_m + tolerance * scene.grid().voxel_m);
  const Vec3 low = a.cwiseMin(b), high = a.cwiseMax(b);
  return scene.room_is_clear(low.cwiseMin(low + reach) - around, high.cwiseMax(high + reach) + around);
}

TEST(PostureField, KeepsTheToolOffWhatStandsBesideTheStock) {
  const Cell cell = parse_cell(clamped_cell());
  const Scene scene(cell, cell.grid(16), VoxelSet(16, true));
  int in_the_way = 0;
  for (int which : {0, 2}) {
    const ToolView view = tool_views(16)[static_cast<std::size_t>(which)];
    const PostureField field = make_field(scene, cell.home(scene.chain()), view);
    for (int trial = 0; trial < 2000; ++trial) {
      Random random(mix(5, static_cast<std::uint64_t>(trial)));
      const Vec3 from = random_cell(random), to = random_cell(random);
      SCOPED_TRACE(::testing::Message() << "direction " << which << ", trial " << trial);
      const bool clear = tool_is_clear(scene, field, from, from, 0.04);
      in_the_way += !clear;
      ASSERT_TRUE(clear || !field.usable(from)) << from.transpose();
      ASSERT_TRUE(!field.allows_wide_path(from, to) || tool_is_clear(scene, field, from, to, 0.5));
    }
  }
  EXPECT_GT(in_the_way, 20);
}

TEST(PostureField, EdgesWithFreeLinksAreCertifiedWithoutMaterialToo) {
  const PandaField& panda = PandaField::get();
  const Scene empty(panda.cell, panda.grid, VoxelSet(16));
  Random random(3);
  int free = 0, asked = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const Vec3 from = random_cell(random);
    Vec3 to = from;
    for (int axis = 0; axis < 3; ++axis) to[axis] += random.between(-1.5, 1.5);
    to = to.cwiseMax(0).cwiseMin(Vec3(15, 15, top));
    SCOPED_TRACE(::testing::Message() << "trial " << trial << ", " << from.transpose() << " to " << to.transpose());
    const auto q = panda.field.at(from), r = panda.field.at(to);
    if (!q || !r) continue;
    ++asked;
    int held = -1;
    if (!panda.field.links_are_free(from, *q, to, *r, held)) continue;
    ++free;
    ASSERT_GE(held, 0);
    int known = held;
    ASSERT_TRUE(panda.field.links_are_free(to, *r, from, *q, known));
    // The other certificate: distances against motion bounds, by bisection. The plate is in it as well, and what comes
    // as near to it as the lowest layer bends too much at this length.
    if (std::min(from.z(), to.z()) < 1) continue;
    ASSERT_EQ(empty.certify(*q, *r), Contact::none);
  }
  EXPECT_GT(asked, 400);
  EXPECT_GT(free, asked * 9 / 10);
}

TEST(PostureField, LinksAreNotFreeAlongAnEdgeThatLeavesEveryBubble) {
  const PandaField& panda = PandaField::get();
  const auto q = panda.field.at({8, 8, 12});
  ASSERT_TRUE(q);
  Configuration through_the_stock = *q;
  through_the_stock[2] += 0.8;  // the shoulder leans forward
  ASSERT_NE(panda.scene.certify(*q, through_the_stock), Contact::none);
  int held = -1;
  ASSERT_TRUE(panda.field.links_are_free({8, 8, 12}, *q, {8, 8, 12}, *q, held));
  const int before = held;
  EXPECT_FALSE(panda.field.links_are_free({8, 8, 12}, *q, {8, 8, 12}, through_the_stock, held));
  EXPECT_EQ(held, before);
}

TEST(PostureField, RefiningTakesNothingAway) {
  const PandaField& panda = PandaField::get();
  PostureField refined = panda.field;
  refined.refine(panda.scene, panda.scene.full_stock(), 1, {});
  EXPECT_GE(refined.usable_cells(), panda.field.usable_cells());
  Random random(4);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 cell = random_cell(random);
    ASSERT_TRUE(!panda.field.usable(cell) || refined.usable(cell)) << "trial " << trial;
  }
}

}  // namespace
}  // namespace sculpt
