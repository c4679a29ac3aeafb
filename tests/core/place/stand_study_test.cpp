#include "core/place/stand_study.hpp"

#include <gtest/gtest.h>

#include <array>

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

/// By sector of the view: do 60 draws find a posture there, free of contacts, and everywhere from there out?
std::array<bool, all_sectors> draw_holds(const Scene& scene, const ToolView& view, Random& random) {
  std::array<bool, all_sectors> holds{};
  for (int k = sectors_along - 1; k >= 0; --k)
    for (int j = sectors_along - 1; j >= 0; --j)
      for (int i = sectors_along - 1; i >= 0; --i) {
        const Vec3 cell(sector_middle(i, n), sector_middle(j, n), sector_middle(k, n));
        bool& held = holds[sector_index({i, j, k})];
        for (int draw = 0; draw < 60 && !held; ++draw) {
          const auto q = solve_ik(scene.chain(), {view.ball_m(scene.grid(), cell), view.axis()},
                                  random_configuration(scene.chain(), random));
          if (!q) continue;
          // Links and holder against everything; ball and shank may be in the material.
          const Configuration half = Configuration::Constant(q->size(), 1e-6);
          Scene::Pairs pairs = scene.pairs();
          held = !scene.bubble(*q, {*q - half, *q + half}, {}, scene.full_stock(), pairs).empty();
        }
        for (int part = 1; part < 8; ++part) {
          const Voxel up{part & 1, part >> 1 & 1, part >> 2}, next = Voxel{i, j, k} + up;
          const bool is_out = up.i > view.lean.i || up.j > view.lean.j || up.k > view.lean.k || !is_sector(next);
          held = held && (is_out || holds[sector_index(next)]);
        }
      }
  return holds;
}

/// The study looks from a few seeds, along one branch after the other; drawing looks everywhere and mixes branches.
TEST(StandStudy, DrawingPosturesAtRandomFindsLittleThatTheStudyMisses) {
  Random random(3);
  for (const auto& [name, by] :
       {std::pair("panda-turntable", Vec3(0.2, 0.2, 0.1)), std::pair("panda-turntable", Vec3(-0.1, -0.3, 0)),
        std::pair("panda-turntable-6mm", Vec3(0.1, 0, 0.05)), std::pair("gantry", Vec3(0.1, 0, 0))}) {
    const Cell cell = shipped_cell(name);
    const int joint = find_moved_joint(cell, Moved::table);
    Stand stand = stand_of(cell, joint);
    stand.at_m += by;
    const ArmReach reach = make_study(cell, joint).find(stand);
    const Cell moved = cell_at(cell, joint, stand);
    const Scene scene(moved, moved.grid(n), VoxelSet(n, true));
    int asked = 0, missed = 0, dreamt = 0;
    for (std::size_t view = 0; view < all_views; view += 4) {
      const auto drawn = draw_holds(scene, study_views(n)[view], random);
      const ToolView sectors = study_views(sectors_along)[view];
      for (int at = 0; at < all_sectors; ++at) {
        const Voxel sector{at % sectors_along, at / sectors_along % sectors_along, at / sectors_along / sectors_along};
        const bool held = reach.holds[view][sector_index(sectors.voxel(sector))] == Hold::held;
        ++asked;
        missed += drawn[sector_index(sector)] && !held;
        dreamt += held && !drawn[sector_index(sector)];
      }
    }
    EXPECT_LE(dreamt, asked / 50) << name << " " << by.transpose() << " of " << asked;
    EXPECT_LE(missed, asked / 10) << name << " " << by.transpose() << " of " << asked;
  }
}

TEST(StandStudy, AHomeWithTheToolInTheBlockIsNotFree) {
  const Cell cell = shipped_cell("panda-turntable");
  const int joint = find_moved_joint(cell, Moved::table);
  Stand stand = stand_of(cell, joint);
  stand.at_m = {0.4, 0, 0.3};
  const ArmReach reach = make_study(cell, joint).find(stand);
  EXPECT_FALSE(reach.home_is_free);
  ASSERT_TRUE(reach.above);
  Cell moved = cell_at(cell, joint, stand);
  const Scene scene(moved, moved.grid(n), VoxelSet(n, true));
  EXPECT_NE(scene.contact_at(cell.home(scene.chain())), Contact::none);
  EXPECT_EQ(scene.contact_at(*reach.above), Contact::none);
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

Cell bench_cell(const std::string& name) {
  return parse_cell(read_cell_files(SOURCE_DIR "/bench/cells_data/cells/" + name + ".json"));
}

/// Voxels to be removed with nothing that is kept above them.
std::uint64_t count_open_to_the_sky(const VoxelGrid& voxels) {
  std::uint64_t open = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (int k = n - 1; k >= 0 && voxels.label({i, j, k}) == Label::remove; --k) ++open;
  return open;
}

// Postures for other directions than its own were said to be certified.
TEST(StandStudy, AScaraReachesWhatIsOpenToTheSkyAndNothingElse) {
  const Cell cell = bench_cell("scara");
  const int joint = find_moved_joint(cell, Moved::table);
  const VoxelGrid voxels = ball();
  const ArmReach reach = make_study(cell, joint).find(stand_of(cell, joint));
  const Share estimate = find_share(find_demand(voxels, {no_turn}, Access::along_views, run), {&reach});
  EXPECT_EQ(estimate.held, count_open_to_the_sky(voxels));
  EXPECT_EQ(certify_stand(cell, voxels, run).held, count_open_to_the_sky(voxels));
}

TEST(StandStudy, ARobotAtTheCeilingIsLookedAtLikeAnyOther) {
  const Cell cell = bench_cell("iiwa-ceiling");
  const VoxelGrid voxels = ball();
  const Demand demand = find_demand(voxels, {no_turn}, Access::along_views, run);
  for (const Moved moved : {Moved::table, Moved::base}) {
    const int joint = find_moved_joint(cell, moved);
    Stand stand = stand_of(cell, joint);
    const ArmReach reach = make_study(cell, joint).find(stand);
    EXPECT_TRUE(reach.home_is_free);
    EXPECT_NEAR(find_share(demand, {&reach}).of_removable(), certify_stand(cell, voxels, run).of_removable(), 0.05);
    stand.at_m = moved == Moved::base ? Vec3(0.5, 0, 0.3) : Vec3(0, 0, 1.2);  // each where the other is
    const ArmReach jammed = make_study(cell, joint).find(stand);
    EXPECT_EQ(find_share(demand, {&jammed}).held, 0u);
  }
}

}  // namespace
}  // namespace sculpt
