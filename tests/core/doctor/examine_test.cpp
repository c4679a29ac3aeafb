#include "core/doctor/examine.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/collision/scene.hpp"
#include "core/doctor/findings_json.hpp"
#include "tests/core/cell/sample_robots.hpp"
#include "tests/core/collision/small_arm.hpp"
#include "tests/core/doctor/doctor_cells.hpp"

namespace sculpt {
namespace {

constexpr int n = 16;

CellFindings examine(const CellDraft& draft, int threads = 2) {
  const QuietRun run(threads);
  return examine_cell(draft, {n, 3, true}, run.context());
}

CellFindings examine(const Cell& cell) {
  return examine(CellDraft{cell, {}});
}

const Fault* fault_of(const CellFindings& found, const std::string& code) {
  const auto at =
      std::find_if(found.faults.begin(), found.faults.end(), [&](const Fault& f) { return f.code == code; });
  return at == found.faults.end() ? nullptr : &*at;
}

Cell with_home(Cell cell, const std::string& joint, double value) {
  cell.rest[static_cast<std::size_t>(cell.robot.find_joint(joint))] = value;
  return cell;
}

/// The cell at the home that was found for it.
Cell at_better_home(Cell cell, const CellFindings& found) {
  for (const auto& [joint, value] : found.better_home.value()) cell = with_home(cell, joint, value);
  return cell;
}

TEST(Examine, AShippedCellIsReadyAndAllOfItsStockIsReached) {
  const CellFindings found = examine(shipped_cell("panda-turntable"));
  EXPECT_TRUE(found.plannable());
  EXPECT_TRUE(found.faults.empty()) << found.faults.front().sentence;
  EXPECT_EQ(found.chain.size(), 8u);
  EXPECT_TRUE(found.chain.front().carries_stock) << "the table";
  EXPECT_EQ(found.reached, 1);
  ASSERT_EQ(found.directions.size(), 5u);
  for (const DirectionFinding& direction : found.directions) {
    EXPECT_EQ(direction.free, 27) << direction.name;
    EXPECT_GT(direction.field, 0.97) << direction.name;
  }
}

TEST(Examine, ATranslatingRobotIsLookedAtAlongItsOnlyDirection) {
  const CellFindings found = examine(shipped_cell("gantry"));
  EXPECT_TRUE(found.plannable());
  ASSERT_EQ(found.directions.size(), 1u);
  EXPECT_EQ(found.directions.front().free, 27);
}

TEST(Examine, AHomeThatIsBlockedIsNamedWithItsPairsAndAnotherHomeIsFree) {
  const Cell cell = with_home(shipped_cell("panda-turntable"), "joint2", 1.2);
  const CellFindings found = examine(cell);
  EXPECT_FALSE(found.plannable());
  const Fault* fault = fault_of(found, "home_blocked");
  ASSERT_NE(fault, nullptr);
  EXPECT_EQ(fault->weight, Fault::Weight::error);
  EXPECT_FALSE(found.home.blocking.empty());
  EXPECT_NE(fault->sentence.find(found.home.blocking.front().first), std::string::npos) << fault->sentence;
  ASSERT_TRUE(found.better_home);
  EXPECT_TRUE(examine(at_better_home(cell, found)).plannable());
}

TEST(Examine, AHomeBelowTheTopOfTheStockIsAWarning) {
  Cell cell = shipped_cell("panda-turntable");
  cell.stock_origin_m += Vec3(0.15, 0, 0.3);  // the ball now is beside it
  const CellFindings found = examine(cell);
  ASSERT_NE(fault_of(found, "home_low"), nullptr);
  EXPECT_EQ(fault_of(found, "home_low")->weight, Fault::Weight::warning);
}

TEST(Examine, WhatIsWrongWithHomeInTheFileIsAFaultAndNoEnd) {
  CellFiles files;
  const Cell cell = make_test_cell();
  files.files["arm.urdf"] = cell.urdf;
  files.cell_json = R"({"urdf": "arm.urdf", "stock": {"link": "disc", "size_m": 0.16, "origin_m": [-0.08, -0.08, 0]},
    "tool": {"link": "nose", "stickout_m": 0.2, "ball_radius_voxels": 0.45},
    "home": {"shoulder": 9, "knee": 1, "elbow": "bent"}})";
  const CellDraft draft = draft_cell(files);
  EXPECT_EQ(draft.home_faults.size(), 3u);
  EXPECT_EQ(draft.cell.rest[static_cast<std::size_t>(cell.robot.find_joint("shoulder"))], 1.5) << "its upper limit";
  EXPECT_THROW(parse_cell(files), InputError);
  const CellFindings found = examine(draft);
  EXPECT_FALSE(found.plannable());
  EXPECT_EQ(
      std::count_if(found.faults.begin(), found.faults.end(), [](const Fault& f) { return f.code == "home_invalid"; }),
      3);
}

TEST(Examine, AToolThatIsShorterThanTheStockIsTold) {
  Cell cell = shipped_cell("panda-turntable");
  cell.tool.stickout_m = 0.1;
  EXPECT_NE(fault_of(examine(cell), "short_tool"), nullptr);
}

TEST(Examine, AToolThatIsTooThickIsAnErrorAndTheRestIsLookedAt) {
  const Cell cell = shipped_cell("panda-turntable-6mm");
  const QuietRun run;
  const CellFindings found = examine_cell({cell, {}}, {64, 3, false}, run.context());
  EXPECT_FALSE(found.plannable());
  EXPECT_NE(fault_of(found, "tool_too_large"), nullptr);
  EXPECT_EQ(found.resolution, 32);
  EXPECT_EQ(found.directions.size(), 5u);
}

TEST(Examine, JointsBesideTheChainAreNamed) {
  Cell cell = make_test_cell();
  std::string urdf = cell.urdf;
  urdf.insert(urdf.rfind("</robot>"),
              R"(<link name="piston"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
    <joint name="rod" type="prismatic"><parent link="upper"/><child link="piston"/><origin xyz="-0.1 0 0.2"/>
      <limit lower="0" upper="0.1" effort="1" velocity="1"/></joint>)");
  cell.robot = parse_plain(urdf);
  cell.rest.assign(cell.robot.joints.size(), 0);
  for (const auto& [joint, value] : {std::pair{"shoulder", -0.6}, {"elbow", 1.2}, {"wrist", 1.0}})
    cell = with_home(cell, joint, value);
  cell.stock_link = cell.robot.find_link("disc");
  cell.tool_link = cell.robot.find_link("nose");
  const CellFindings found = examine(cell);
  ASSERT_EQ(found.idle_joints.size(), 1u);
  EXPECT_EQ(found.idle_joints.front().name, "rod");
  EXPECT_TRUE(found.idle_joints.front().rides_on_the_arm);
  ASSERT_NE(fault_of(found, "idle_joint"), nullptr);
}

TEST(Examine, AToolThatPointsIntoTheArmIsTold) {
  Cell cell = shipped_cell("panda-turntable");
  EXPECT_EQ(fault_of(examine(cell), "tool_in_link"), nullptr);
  const int nose = cell.robot.links[static_cast<std::size_t>(cell.tool_link)].parent_joint;
  cell.robot.joints[static_cast<std::size_t>(nose)].origin.rotate(Eigen::AngleAxisd(3.14159265, Vec3::UnitX()));
  const CellFindings found = examine(cell);
  ASSERT_NE(fault_of(found, "tool_in_link"), nullptr);
  EXPECT_EQ(fault_of(found, "tool_in_link")->weight, Fault::Weight::warning);
}

TEST(Examine, APistonThatNothingDrivesIsNamedWhereItIsInTheWay) {
  Cell cell = shipped_cell("panda-turntable");
  std::string urdf = cell.urdf;
  urdf.insert(urdf.rfind("</robot>"),
              R"(<link name="piston"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
    <joint name="rod" type="prismatic"><parent link="link1"/><child link="piston"/><origin xyz="-0.08 0 0.3"/>
      <limit lower="0" upper="0.1" effort="1" velocity="1"/></joint>)");
  const Robot before = cell.robot;
  cell.robot = parse_plain(urdf);
  std::vector<double> rest(cell.robot.joints.size(), 0);
  for (std::size_t joint = 0; joint < before.joints.size(); ++joint)
    rest[static_cast<std::size_t>(cell.robot.find_joint(before.joints[joint].name))] = cell.rest[joint];
  cell.rest = rest;
  cell.stock_link = cell.robot.find_link("stock");
  cell.tool_link = cell.robot.find_link("spindle_nose");
  cell.ignore_pairs.clear();
  const CellFindings found = examine(cell);
  const Fault* fault = fault_of(found, "home_blocked");
  ASSERT_NE(fault, nullptr);
  EXPECT_NE(fault->cure.find("joint 'rod' that moves 'piston'"), std::string::npos) << fault->cure;
}

TEST(Examine, LinksWithoutAShapeAreTold) {
  Cell cell = make_test_cell();
  cell.robot.links[static_cast<std::size_t>(cell.robot.find_link("fore"))].shapes.clear();
  const CellFindings found = examine(cell);
  ASSERT_NE(fault_of(found, "no_shape"), nullptr);
  EXPECT_NE(fault_of(found, "no_shape")->sentence.find("'fore'"), std::string::npos);
}

TEST(Examine, AStockOutOfReachIsAnError) {
  Cell cell = shipped_cell("panda-turntable");
  cell.stock_origin_m.z() = 3;
  const CellFindings found = examine(cell);
  ASSERT_NE(fault_of(found, "nothing_reached"), nullptr);
  EXPECT_GT(found.directions.front().out_of_reach, 0);
}

TEST(Examine, ATableThatIsTooFarIsToldWhereItWouldBeBetter) {
  Cell cell = shipped_cell("panda-turntable");
  cell.robot.joints[static_cast<std::size_t>(cell.robot.find_joint("table"))].origin.translation().x() = 1.0;
  const CellFindings found = examine(cell);
  EXPECT_LT(found.directions.front().free, 27) << "upright it is too far away";
  const Fault* fault = fault_of(found, "better_place");
  ASSERT_NE(fault, nullptr);
  EXPECT_NE(fault->cure.find("joint 'table'"), std::string::npos) << fault->cure;
  EXPECT_NE(fault->cure.find("along x"), std::string::npos) << fault->cure;
}

TEST(Examine, SaysTheSameOnAnyNumberOfThreads) {
  const CellDraft draft{with_home(shipped_cell("panda-turntable"), "joint2", 1.2), {}};
  CellFindings one = examine(draft, 1), four = examine(draft, 4);
  for (CellFindings* found : {&one, &four}) found->scene_s = found->fields_s = 0;
  EXPECT_EQ(findings_json(one), findings_json(four));
}

TEST(Examine, CanBeCancelled) {
  const QuietRun run;
  std::stop_source stop;
  stop.request_stop();
  const Watch watch{stop.get_token(), {}};
  EXPECT_THROW(examine_cell({shipped_cell("panda-turntable"), {}}, {n}, {0, run.helpers, watch}), Cancelled);
}

}  // namespace
}  // namespace sculpt
