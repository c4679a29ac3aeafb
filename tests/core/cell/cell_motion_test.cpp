// Limits and axes in a cell file, and what is said of wrong ones.
#include <gtest/gtest.h>

#include <numbers>

#include "core/base/error.hpp"
#include "core/cell/cell.hpp"
#include "core/cell/shipped_cells.hpp"

namespace sculpt {
namespace {

const std::string urdf = R"(<robot name="r"><link name="room"/><link name="rail"/><link name="head"/><link name="post"/>
  <joint name="lift" type="prismatic"><parent link="room"/><child link="rail"/><axis xyz="0 0 1"/>
  <limit lower="0.1" upper="0.5" velocity="1" effort="1"/></joint>
  <joint name="turn" type="continuous"><parent link="rail"/><child link="head"/><axis xyz="0 0 1"/></joint>
  <joint name="bolt" type="fixed"><parent link="room"/><child link="post"/></joint></robot>)";

Cell cell_with(const std::string& field) {
  return parse_cell({"test",
                     R"({"urdf": "r.urdf", "stock": {"link": "room", "size_m": 0.2, "origin_m": [1, 2, 3]},
  "tool": {"link": "head", "ball_radius_voxels": 0.4}, "home": {"lift": 0.2}, )" +
                         field + "}",
                     {{"r.urdf", urdf}}});
}

JointLimits limits_of(const Cell& cell, const std::string& joint) {
  return cell.limits[static_cast<std::size_t>(cell.robot.find_joint(joint))];
}

std::string refusal(const std::string& field) {
  try {
    cell_with(field);
    return "accepted";
  } catch (const InputError& error) {
    return error.code() + ": " + error.what();
  }
}

void expect_refused(const std::string& field, const std::string& where, const std::string& cure) {
  SCOPED_TRACE(field);
  const std::string said = refusal(field);
  EXPECT_TRUE(said.starts_with("cell_invalid: ")) << said;
  EXPECT_NE(said.find(where), std::string::npos) << said;
  EXPECT_NE(said.find(cure), std::string::npos) << said;
}

TEST(CellMotion, VelocityIsTheUrdfsUnlessTheCellFileOverrulesIt) {
  const Cell cell = cell_with(R"("limits": {"lift": {"acceleration": 2, "jerk": 50},
    "turn": {"velocity": 3, "acceleration": 4, "jerk": 5}})");
  const auto of = [&](const char* joint) { return limits_of(cell, joint); };
  EXPECT_EQ(of("lift").velocity, 1);
  EXPECT_EQ(of("lift").acceleration, 2);
  EXPECT_EQ(of("lift").jerk, 50);
  EXPECT_EQ(of("turn").velocity, 3);
  EXPECT_EQ(
      limits_of(cell_with(R"("limits": {"lift": {"velocity": 0.5, "acceleration": 2, "jerk": 50}})"), "lift").velocity,
      0.5);
  EXPECT_EQ(limits_of(cell_with(R"("name": "no limits")"), "lift").velocity, 1);
}

TEST(CellMotion, WrongLimitsAreRefusedWithTheCure) {
  expect_refused(R"("limits": {"lift": {"acceleration": 0, "jerk": 1}})", "/limits/lift/acceleration", "above 0");
  expect_refused(R"("limits": {"lift": {"acceleration": 1, "jerk": -1}})", "/limits/lift/jerk", "m/s^3");
  expect_refused(R"("limits": {"lift": {"velocity": 0, "acceleration": 1, "jerk": 1}})", "/limits/lift/velocity",
                 "above 0");
  expect_refused(R"("limits": {"lift": {"jerk": 1}})", "/limits/lift/acceleration", "missing field");
  expect_refused(R"("limits": {"lift": {"acceleration": 1}})", "/limits/lift/jerk", "missing field");
  expect_refused(R"("limits": {"turn": {"acceleration": 1, "jerk": 1}})", "/limits/turn", "give it in rad/s");
  expect_refused(R"("limits": {"tilt": {"acceleration": 1, "jerk": 1}})", "/limits/tilt", "lift, turn");
  expect_refused(R"("limits": {"bolt": {"acceleration": 1, "jerk": 1}})", "/limits/bolt", "leave it out");
  expect_refused(R"("limits": {"lift": {"acceleration": 1, "jerk": 1, "snap": 1}})", "/limits/lift/snap", "jerk");
  expect_refused(R"("limits": [])", "/limits", "an object");
}

TEST(CellMotion, AxesAreReadInTheirUnits) {
  const Cell cell = cell_with(R"("programs": {"axes": [{"axis": "A1", "joint": "turn", "scale": -1, "offset_deg": 90},
    {"axis": "E1", "joint": "lift", "offset_m": 0.1}], "couple": [{"axis": "A1", "minus": "E1"}]})");
  ASSERT_EQ(cell.programs.axes.size(), 2u);
  EXPECT_EQ(cell.programs.axes[0].scale, -1);
  EXPECT_DOUBLE_EQ(cell.programs.axes[0].offset, std::numbers::pi / 2);
  EXPECT_EQ(cell.programs.axes[1].offset, 0.1);
  ASSERT_EQ(cell.programs.couple.size(), 1u);
  EXPECT_EQ(cell.programs.couple[0].minus, "E1");
}

TEST(CellMotion, WrongAxesAreRefusedWithTheCure) {
  const auto axes = [](const std::string& list) { return R"("programs": {"axes": [)" + list + "]}"; };
  expect_refused(axes(R"({"axis": "A1", "joint": "tilt"})"), "/programs/axes/0/joint", "lift, turn");
  expect_refused(axes(R"({"axis": "A1", "joint": "turn", "scale": 0})"), "/programs/axes/0/scale", "-1");
  expect_refused(axes(R"({"axis": "A1", "joint": "lift", "offset_deg": 1})"), "/programs/axes/0", "offset_m");
  expect_refused(axes(R"({"axis": "A1", "joint": "lift"}, {"axis": "A2", "joint": "lift"})"), "/programs/axes/1/joint",
                 "one axis");
  expect_refused(axes(R"({"axis": "A1", "joint": "lift"}, {"axis": "A1", "joint": "turn"})"), "/programs/axes/1/axis",
                 "already");
  expect_refused(axes(""), "/programs/axes", "at least one");
  expect_refused(
      R"("programs": {"axes": [{"axis": "A1", "joint": "lift"}], "couple": [{"axis": "A1", "minus": "A2"}]})",
      "/programs/couple/0/minus", "A2");
}

TEST(CellMotion, ShippedCellsHaveLimitsForEveryJointOfTheirChain) {
  const std::filesystem::path folder = std::filesystem::path(SOURCE_DIR) / "config/cells";
  const std::vector<std::filesystem::path> folders{folder};
  const std::vector<std::string> names = cell_names(folders);
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const Cell cell = parse_cell(read_cell_files(folder / (name + ".json")));
    const Chain chain = cell.chain();
    for (const int joint : chain.joints()) {
      const JointLimits& limits = cell.limits[static_cast<std::size_t>(joint)];
      EXPECT_GT(limits.velocity, 0);
      EXPECT_GT(limits.acceleration, 0);
      EXPECT_GT(limits.jerk, 0);
    }
  }
}

}  // namespace
}  // namespace sculpt
