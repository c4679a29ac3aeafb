#include "core/doctor/make/new_cell.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/collision/scene.hpp"
#include "core/doctor/examine.hpp"
#include "core/doctor/make/find_tool.hpp"
#include "core/doctor/make/urdf_text.hpp"
#include "core/verify/home_contacts.hpp"
#include "tests/core/cell/sample_robots.hpp"
#include "tests/core/doctor/doctor_cells.hpp"

namespace sculpt {
namespace {

MakersRobot maker(const std::string& urdf = without_branch(makers_arm, "hand")) {
  return {urdf, [](const std::string& reference) -> std::string { throw InputError("file_missing", reference); }};
}

NewCell make(const CellWishes& wishes, const MakersRobot& robot = maker()) {
  const QuietRun run;
  return make_cell(robot, wishes, run.context());
}

/// The cell as everybody will read it.
Cell read_back(const NewCell& made) {
  CellFiles files;
  files.name = "made";
  files.cell_json = cell_text(made.cell, "made.urdf", {});
  files.files["made.urdf"] = made.urdf;
  return parse_cell(files);
}

void expect_free_home(const Cell& cell) {
  const Grid grid = cell.grid(64);
  const Scene scene(cell, grid, VoxelSet(grid.n, true));
  EXPECT_EQ(scene.contact_at(cell.home(scene.chain())), Contact::none)
      << scene.describe_contact(cell.home(scene.chain()));
}

TEST(NewCell, AnArmAloneGetsATableAToolAndAHomeThatIsFree) {
  const NewCell made = make({});
  EXPECT_TRUE(made.has_home);
  EXPECT_FALSE(made.remarks.empty()) << "all of it was assumed";
  const Cell cell = read_back(made);
  EXPECT_EQ(cell.chain().dof(), 7) << "the arm and the turntable";
  EXPECT_EQ(cell.rest, made.cell.rest);
  expect_free_home(cell);
}

TEST(NewCell, TheToolPointsOutOfTheFlangeWhateverItsFrame) {
  const Robot robot = parse_plain(makers_arm);
  EXPECT_EQ(find_flange(robot), robot.find_link("flange")) << "fingers are no part of the row";
  EXPECT_TRUE(find_way_out(robot, robot.find_link("flange")).isApprox(Vec3::UnitX()));
  const Cell cell = make({}).cell;
  std::vector<Frame> at;
  const Chain chain = cell.chain();
  chain.link_poses(cell.home(chain), at);
  const Frame& flange = at[static_cast<std::size_t>(cell.robot.find_link("flange"))];
  const ToolPose pose = chain.tool_pose(cell.home(chain));
  EXPECT_TRUE((-pose.axis).isApprox(flange.linear().col(0), 1e-6));
}

TEST(NewCell, WishesAreKept) {
  CellWishes wishes;
  wishes.stock_size_m = 0.1;
  wishes.stickout_m = 0.15;
  wishes.ball_radius_m = 0.003;
  wishes.table = Table::fixed;
  wishes.table_at_m = Vec3(0.5, 0.05, 0.1);
  const Cell cell = read_back(make(wishes));
  EXPECT_EQ(cell.stock_size_m, 0.1);
  EXPECT_EQ(cell.tool.stickout_m, 0.15);
  EXPECT_FALSE(cell.tool.in_voxels);
  EXPECT_EQ(cell.chain().dof(), 6) << "the table stands still";
  std::vector<Frame> at;
  cell.chain().link_poses(Configuration::Zero(6), at);
  EXPECT_TRUE(at[static_cast<std::size_t>(cell.robot.find_link("base"))].translation().isApprox(-*wishes.table_at_m));
}

TEST(NewCell, NamesThatTheMakerTookStayHis) {
  std::string urdf = without_branch(makers_arm, "hand");
  urdf = with_elements(
      urdf, R"(<link name="room"/><joint name="table" type="fixed"><parent link="base"/><child link="room"/></joint>)");
  const NewCell made = make({}, maker(urdf));
  EXPECT_GE(read_back(made).robot.find_link("room_2"), 0);
  EXPECT_GE(read_back(made).robot.find_joint("table_2"), 0);
}

TEST(NewCell, AGripperInTheWayIsNamed) {
  const NewCell made = make({}, maker(makers_arm));
  const auto named = [](const std::string& remark) { return remark.find("'hand' hangs on") != std::string::npos; };
  EXPECT_TRUE(std::any_of(made.remarks.begin(), made.remarks.end(), named));
}

/// The arm with a bar beside its wrist, and before it two jaws that the bar is clear of near 0 only.
std::string jawed_arm() {
  std::string urdf = without_branch(makers_arm, "hand");
  const auto put = [&](const std::string& text, const std::string& before) { urdf.insert(urdf.find(before), text); };
  for (const char* z : {"0.06", "-0.06"})
    put("<collision><origin xyz='0.14 0.1 " + std::string(z) +
            "'/><geometry><box size='0.1 0.03 0.04'/></geometry></collision>",
        "</link>\n  <joint name=\"j4\"");
  const std::string bare = "<link name=\"l5\"/>";
  urdf.replace(urdf.find(bare), bare.size(),
               "<link name='l5'><collision><origin xyz='0.06 0.1 0'/><geometry><box size='0.1 0.03 0.03'/></geometry>"
               "</collision></link>");
  return urdf;
}

TEST(NewCell, NeighboursThatTouchAlongMostOfTheirTravelMayAndAreNamed) {
  const NewCell made = make({}, maker(jawed_arm()));
  EXPECT_TRUE(made.has_home);
  const Cell cell = read_back(made);
  const LinkPair jaws = std::minmax(cell.robot.find_link("l4"), cell.robot.find_link("l5"));
  EXPECT_EQ(cell.ignore_pairs, std::vector{jaws});
  const auto named = [](const std::string& remark) {
    return remark.find("'l4' and 'l5' touch along ") != std::string::npos && remark.find("'j5'") != std::string::npos;
  };
  EXPECT_EQ(std::ranges::count_if(made.remarks, named), 1);
}

TEST(NewCell, TheDoctorNamesNeighboursThatLeaveTheirJointLittleRoom) {
  Cell cell = make({}, maker(jawed_arm())).cell;
  cell.ignore_pairs.clear();
  cell.rest[static_cast<std::size_t>(cell.robot.find_joint("j5"))] = 0;
  const QuietRun run;
  const CellFindings found = examine_cell({cell, {}}, {16, 3, false}, run.context());
  const auto fault = std::ranges::find(found.faults, "wide_contact", &Fault::code);
  ASSERT_NE(fault, found.faults.end());
  EXPECT_NE(fault->sentence.find("'l4' and 'l5' touch along "), std::string::npos) << fault->sentence;
  EXPECT_NE(fault->cure.find("[\"l4\", \"l5\"] to \"ignore_pairs\""), std::string::npos) << fault->cure;
}

/// The arm with a plate on its forearm that is in a bar of its wrist along 60 % of the travel, away from the joint's
/// axis.
std::string bumped_arm() {
  std::string urdf = without_branch(makers_arm, "hand");
  urdf.insert(urdf.find("</link>\n  <joint name=\"j4\""),
              "<collision><origin xyz='0.14 0.1 0'/><geometry><box size='0.06 0.03 0.24'/></geometry></collision>");
  const std::string bare = "<link name=\"l5\"/>";
  urdf.replace(urdf.find(bare), bare.size(),
               "<link name='l5'><collision><origin xyz='0.05 0.1 0'/><geometry><box size='0.1 0.03 0.03'/></geometry>"
               "</collision></link>");
  return urdf;
}

TEST(NewCell, WhatTheReplayWouldFindInContactAtHomeMayTouchOrIsAnError) {
  const Cell cell = read_back(make({}, maker(bumped_arm())));
  EXPECT_TRUE(find_home_contacts(cell, cell.chain().joints()).empty());
  const LinkPair bumped = std::minmax(cell.robot.find_link("l4"), cell.robot.find_link("l5"));
  EXPECT_EQ(cell.ignore_pairs, std::vector{bumped});

  Cell strict = cell;
  strict.ignore_pairs.clear();
  strict.rest[static_cast<std::size_t>(strict.robot.find_joint("j5"))] = 0;
  EXPECT_EQ(find_home_contacts(strict, strict.chain().joints()), std::vector{bumped});
  const QuietRun run;
  const CellFindings found = examine_cell({strict, {}}, {16, 3, false}, run.context());
  EXPECT_FALSE(found.plannable());
  const auto fault = std::ranges::find(found.faults, "home_contact", &Fault::code);
  ASSERT_NE(fault, found.faults.end());
  EXPECT_NE(fault->cure.find("[\"l4\", \"l5\"] to \"ignore_pairs\""), std::string::npos) << fault->cure;
}

TEST(NewCell, ASpindleThatTheForkOfTheWristHasNoRoomForIsMadeSlimmer) {
  std::string urdf = without_branch(makers_arm, "hand");
  urdf.insert(urdf.find("</link>\n  <joint name=\"j4\""),
              "<collision><origin xyz='0.08 0.08 0'/><geometry><box size='0.4 0.03 0.4'/></geometry></collision>"
              "<collision><origin xyz='0.08 -0.08 0'/><geometry><box size='0.4 0.03 0.4'/></geometry></collision>");
  CellWishes wishes;
  wishes.stock_size_m = 0.5;
  const Cell cell = read_back(make(wishes, maker(urdf)));
  const Link& spindle = cell.robot.links[static_cast<std::size_t>(cell.robot.find_link("spindle"))];
  EXPECT_LT(spindle.shapes.front().radius_m, 0.065) << "half of the room between the cheeks";
  EXPECT_GT(spindle.shapes.front().radius_m, 0.03);
}

TEST(NewCell, ThatAWristHasNoRoomForASpindleOfAnyWidthIsSaid) {
  std::string urdf = without_branch(makers_arm, "hand");
  urdf.insert(urdf.find("</link>\n  <joint name=\"j4\""),
              "<collision><origin xyz='0.2 0 0'/><geometry><box size='0.6 0.4 0.4'/></geometry></collision>");
  const auto says_so = [](const NewCell& made) {
    return std::ranges::any_of(made.remarks, [](const std::string& said) {
      return said.find("a spindle of any width touches the wrist: give a link farther out with --tool-link") == 0;
    });
  };
  EXPECT_TRUE(says_so(make({}, maker(urdf))));
  EXPECT_FALSE(says_so(make({}, maker(without_branch(makers_arm, "hand")))));
}

TEST(NewCell, Tool0PointsOutAlongItsZ) {
  std::string urdf = without_branch(makers_arm, "hand");
  const std::string flange = "<link name=\"flange\"/>", at = "<child link=\"flange\"/><origin xyz=\"0.07 0 0\"/>";
  urdf.replace(urdf.find(at), at.size(), "<child link=\"tool0\"/><origin xyz=\"0 0 0\" rpy=\"0 1.570796 0\"/>");
  urdf.replace(urdf.find(flange), flange.size(), "<link name=\"tool0\"/>");
  const Robot robot = parse_plain(urdf);
  EXPECT_EQ(find_way_out(robot, robot.find_link("tool0")), Vec3::UnitZ())
      << "though the flange's shape lies ahead of it";
}

TEST(NewCell, AnArmThatHangsGetsItsTableBelowIt) {
  std::string urdf = without_branch(makers_arm, "hand");
  const std::string base = "  <link name=\"base\">";
  urdf.insert(urdf.find(base),
              "<link name=\"ceiling\"/><joint name=\"mount\" type=\"fixed\"><parent link=\"ceiling\"/><child "
              "link=\"base\"/><origin xyz=\"0 0 2.5\" rpy=\"3.14159265 0 0\"/></joint>\n");
  const NewCell made = make({}, maker(urdf));
  EXPECT_TRUE(made.has_home);
  const Cell cell = read_back(made);
  expect_free_home(cell);
  std::vector<Frame> at;
  const Chain chain = cell.chain();
  chain.link_poses(cell.home(chain), at);
  const auto height = [&](const char* link) {
    return at[static_cast<std::size_t>(cell.robot.find_link(link))].translation().z();
  };
  EXPECT_LT(height("stock"), height("flange"));
  const QuietRun run;
  EXPECT_GT(examine_cell({cell, {}}, {16, 5, false}, run.context()).reached, 0.99);
}

TEST(NewCell, NeighboursWithRoomAreKeptApart) {
  EXPECT_TRUE(make({}).cell.ignore_pairs.empty());
}

TEST(NewCell, LinksThatAreNotThereAreRefused) {
  CellWishes wishes;
  wishes.tool_link = "nose";
  EXPECT_THROW(make(wishes), InputError);
  EXPECT_THROW(make({}, maker("<robot name='r'><link name='stone'/></robot>")), InputError) << "nothing moves";
}

}  // namespace
}  // namespace sculpt
