#include "core/place/stand_study.hpp"

#include <gtest/gtest.h>

#include "core/cell/ik.hpp"
#include "core/collision/scene.hpp"
#include "core/place/certify_stand.hpp"
#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

constexpr int n = 32;
const Eigen::AlignedBox3d whole(Vec3::Zero(), Vec3::Ones());
const Helpers two_threads(2);
const Watch nobody;
const RunContext run{0, two_threads, nobody};

/// A ball that stands on the floor, with something under it that only level tools reach.
VoxelGrid ball() {
  VoxelGrid voxels{VoxelSet(n, true), VoxelSet(n), {}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if ((Vec3(i, j, k) - Vec3(15.5, 15.5, 14)).norm() < 14) voxels.keep.insert({i, j, k});
  return voxels;
}

ReachStudy make_study(const Cell& cell, int joint) {
  return {cell, joint, whole, n, {cell.tool.stickout_m}};
}

TEST(StandStudy, TheShippedCellHoldsItsWholeGridWhereItStands) {
  const Cell cell = shipped_cell("panda-turntable");
  const int joint = find_moved_joint(cell, Moved::table);
  const ArmReach reach = make_study(cell, joint).find(stand_of(cell, joint));
  EXPECT_TRUE(reach.home_is_free);
  ASSERT_TRUE(reach.above);
  for (std::size_t view = 0; view < 5; ++view)
    for (const Hold hold : reach.holds[view]) EXPECT_EQ(hold, Hold::held) << "direction " << view;
}

TEST(StandStudy, BaseAndTableMovedTogetherAnswerTheSame) {
  const Cell cell = shipped_cell("panda-turntable");
  const int table = find_moved_joint(cell, Moved::table), base = find_moved_joint(cell, Moved::base);
  Cell shifted = cell;
  const Vec3 by(0.2, -0.1, 0.15);
  for (const int joint : {table, base}) shifted.robot.joints[static_cast<std::size_t>(joint)].origin.pretranslate(by);
  // The plate stays behind, so it is taken away from both.
  Cell bare = cell;
  for (Cell* one : {&bare, &shifted}) one->robot.links[static_cast<std::size_t>(one->robot.root)].shapes.clear();
  const ArmReach first = make_study(bare, table).find(stand_of(bare, table));
  const ArmReach second = make_study(shifted, table).find(stand_of(shifted, table));
  EXPECT_EQ(first.holds, second.holds);
}

TEST(StandStudy, MovingTheTableIsMovingTheBaseTheOtherWay) {
  Cell cell = shipped_cell("panda-turntable");
  cell.robot.links[static_cast<std::size_t>(cell.robot.root)].shapes.clear();
  const int table = find_moved_joint(cell, Moved::table), base = find_moved_joint(cell, Moved::base);
  Stand of_table = stand_of(cell, table), of_base = stand_of(cell, base);
  const Vec3 by(0.15, 0.1, 0.1);
  of_table.at_m += by;
  of_base.at_m -= by;
  EXPECT_EQ(make_study(cell, table).find(of_table).holds, make_study(cell, base).find(of_base).holds);
}

TEST(StandStudy, FarAwayNothingIsInReach) {
  const Cell cell = shipped_cell("panda-turntable");
  const int joint = find_moved_joint(cell, Moved::table);
  Stand stand = stand_of(cell, joint);
  stand.at_m.x() = 3;
  const ArmReach reach = make_study(cell, joint).find(stand);
  for (const auto& view : reach.holds)
    for (const Hold hold : view) EXPECT_EQ(hold, Hold::reach);
}

TEST(StandStudy, ATranslatingRobotHoldsItsOwnDirectionAndNoOther) {
  const Cell cell = shipped_cell("gantry");
  const int joint = find_moved_joint(cell, Moved::table);
  const ArmReach reach = make_study(cell, joint).find(stand_of(cell, joint));
  for (const Hold hold : reach.holds[0]) EXPECT_EQ(hold, Hold::held);
  for (std::size_t view = 1; view < all_views; ++view)
    for (const Hold hold : reach.holds[view]) EXPECT_NE(hold, Hold::held);
}

TEST(StandStudy, AnyNumberOfThreadsGivesTheSame) {
  const Cell cell = shipped_cell("panda-turntable");
  const int joint = find_moved_joint(cell, Moved::table);
  StandRanges ranges = ranges_around(cell, joint);
  ranges.x.steps = ranges.y.steps = 3;
  ranges.z.steps = 2;
  const Stand own = stand_of(cell, joint);
  const std::vector<Stand> stands = list_stands(ranges, own);
  const ReachStudy study = make_study(cell, joint);
  const Demand demand = find_demand(ball(), {no_turn}, Access::along_views, run);
  const auto rated = [&](int threads) {
    const Helpers helpers(threads);
    return rate_stands(study, demand, stands, own, {0, helpers, nobody});
  };
  const auto one = rated(1), four = rated(4);
  ASSERT_EQ(one.size(), stands.size());
  for (std::size_t at = 0; at < one.size(); ++at) {
    EXPECT_EQ(one[at].stand, four[at].stand);
    EXPECT_EQ(one[at].reach.holds, four[at].reach.holds);
    EXPECT_GE(one[at == 0 ? 0 : at - 1].share.held, one[at].share.held);
  }
}

TEST(StandStudy, TheOwnStandIsAlwaysAmongThem) {
  const Cell cell = shipped_cell("panda-turntable");
  const Stand own = stand_of(cell, find_moved_joint(cell, Moved::table));
  const auto has_own = [&](const std::vector<Stand>& stands) {
    return std::count(stands.begin(), stands.end(), own) == 1;
  };
  StandRanges ranges = ranges_around(cell, find_moved_joint(cell, Moved::table));
  EXPECT_TRUE(has_own(list_stands(ranges, own)));
  ranges.x.steps = 2;
  EXPECT_TRUE(has_own(list_stands(ranges, own)));
}

TEST(StandStudy, ABlockThatStandsInTheFloorIsBlocked) {
  const Cell cell = shipped_cell("gantry");
  const int joint = find_moved_joint(cell, Moved::table);
  Stand stand = stand_of(cell, joint);
  EXPECT_FALSE(make_study(cell, joint).find(stand).is_blocked);
  stand.at_m.z() -= 0.05;  // it stands on the floor plate already, so that is meant: a block in a plate is not new
  EXPECT_FALSE(make_study(cell, joint).find(stand).is_blocked);

  Cell with_wall = cell;
  Shape wall;
  wall.sides_m = Vec3(0.02, 1, 1);
  wall.pose.translation() = Vec3(0.3, 0, 0.5);
  Link& room = with_wall.robot.links[static_cast<std::size_t>(with_wall.robot.root)];
  room.shapes = {wall};
  stand = stand_of(with_wall, joint);
  EXPECT_FALSE(make_study(with_wall, joint).find(stand).is_blocked);
  stand.at_m.x() += 0.25;
  const ArmReach reach = make_study(with_wall, joint).find(stand);
  EXPECT_TRUE(reach.is_blocked);
  for (const Hold hold : reach.holds[0]) EXPECT_EQ(hold, Hold::links);
}

/// Every posture that 60 draws find, in sectors here and there, against what the study says.
TEST(StandStudy, DrawingPosturesAtRandomFindsLittleThatTheStudyMisses) {
  Random random(3);
  for (const auto& [name, by] :
       {std::pair("panda-turntable", Vec3(0.2, 0.2, 0.1)), std::pair("panda-turntable", Vec3(-0.1, -0.3, 0)),
        std::pair("gantry", Vec3(0.1, 0, 0))}) {
    const Cell cell = shipped_cell(name);
    const int joint = find_moved_joint(cell, Moved::table);
    Stand stand = stand_of(cell, joint);
    stand.at_m += by;
    const ArmReach reach = make_study(cell, joint).find(stand);
    const Cell moved = cell_at(cell, joint, stand);
    const Grid grid = moved.grid(n);
    const Scene scene(moved, grid, VoxelSet(n, true));
    const std::vector<ToolView> sectors = study_views(sectors_along);
    int asked = 0, missed = 0, dreamt = 0;
    for (std::size_t view = 0; view < all_views; view += 3)
      for (int sector = 0; sector < all_sectors; sector += 5) {
        const Voxel at{sector % 4, sector / 4 % 4, sector / 16};
        const Vec3 ball = grid.origin_m + cell.stock_size_m / sectors_along * Vec3(at.i + 0.5, at.j + 0.5, at.k + 0.5);
        bool any = false;
        for (int draw = 0; draw < 60 && !any; ++draw) {
          const auto q =
              solve_ik(scene.chain(), {ball, sectors[view].axis()}, random_configuration(scene.chain(), random));
          if (!q) continue;
          std::vector<Frame> poses;
          scene.chain().link_poses(*q, poses);
          const Contact contact = scene.contact_at(*q);
          any = contact == Contact::none || contact == Contact::tool_material;
        }
        const bool held = reach.holds[view][sector_index(at)] == Hold::held;
        ++asked;
        missed += any && !held;
        dreamt += held && !any;
      }
    EXPECT_LE(dreamt, 0) << name << by.transpose() << " of " << asked;
    EXPECT_LE(missed, asked / 20) << name << by.transpose() << " of " << asked;
  }
}

TEST(StandStudy, CancelIsHeard) {
  const Cell cell = shipped_cell("panda-turntable");
  const int joint = find_moved_joint(cell, Moved::table);
  std::stop_source stop;
  stop.request_stop();
  const Watch watch{stop.get_token(), {}};
  EXPECT_THROW(
      rate_stands(make_study(cell, joint), {}, {stand_of(cell, joint)}, stand_of(cell, joint), {0, two_threads, watch}),
      Cancelled);
}

/// What is certified may be less than the samples say, and a little more: a sector counts by its middle alone.
TEST(StandStudy, TheEstimateIsNearToWhatIsCertified) {
  const Cell cell = shipped_cell("panda-turntable");
  const int joint = find_moved_joint(cell, Moved::table);
  const VoxelGrid voxels = ball();
  const Demand demand = find_demand(voxels, {no_turn}, Access::along_views, run);
  const ReachStudy study = make_study(cell, joint);
  for (const Vec3& by : {Vec3(0, 0, 0), Vec3(0.25, 0, 0), Vec3(0.3, 0.25, 0.1), Vec3(-0.25, 0, 0)}) {
    Stand stand = stand_of(cell, joint);
    stand.at_m += by;
    const ArmReach reach = study.find(stand);
    const double estimate = find_share(demand, {&reach}).of_removable();
    const CertifiedShare certified = certify_stand(cell_at(cell, joint, stand), voxels, run);
    EXPECT_NEAR(estimate, certified.of_removable(), 0.05) << by.transpose();
  }
}

}  // namespace
}  // namespace sculpt
