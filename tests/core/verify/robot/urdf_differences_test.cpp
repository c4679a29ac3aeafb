// What the loader reads from a URDF is held against a second reader: each thing that it could get wrong is found.
#include "core/verify/robot/urdf_differences.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "core/base/error.hpp"
#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

const char* const tetrahedron = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

const char* const urdf = R"(<?xml version="1.0"?>
<robot name="all kinds"> <!-- <link name="not there"/> -->
  <link name="table"><collision><origin xyz=" 0.04 +0.04 -5e-2"/><geometry><box size=".4 0.4 0.1"/></geometry></collision></link>
  <link name="bridge"/>
  <joint name="x" type="prismatic"><parent link="table"/><child link="bridge"/><limit lower="-0.1" upper="0.2" velocity="1" effort="1"/></joint>
  <link name="arm">
    <collision><origin rpy="0.1 -0.7 2.5" xyz="0 0.3 0.15"/><geometry><sphere radius="0.01"/></geometry></collision>
    <collision><geometry><cylinder radius="0.02" length="0.3"/></geometry></collision>
  </link>
  <joint name="a3" type="continuous"><parent link="bridge"/><child link="arm"/><origin xyz="0 0 1" rpy="0.3 0.2 -1"/>
    <axis xyz="0 2 0"/></joint>
  <link name="nose"><collision><geometry><mesh filename="tip.obj" scale="1 2 0.5"/></geometry></collision></link>
  <joint name="a4" type="revolute"><parent link="arm"/><child link="nose"/><origin xyz="0.1 0 0.2"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="2" velocity="1" effort="1"/></joint>
  <link name="finger"/>
  <joint name="f" type="prismatic"><parent link="nose"/><child link="finger"/><axis xyz="0 0.6 0.8"/>
    <limit lower="-0.05" upper="0.4" velocity="1" effort="1"/><mimic joint="x" multiplier="-2" offset="0.1"/></joint>
  <link name="thumb"/>
  <joint name="g" type="revolute"><parent link="nose"/><child link="thumb"/><limit lower="-3" upper="3" velocity="1" effort="1"/><mimic joint="f" multiplier="3"/></joint>
  <link name="cap"/>
  <joint name="lid" type="fixed"><parent link="nose"/><child link="cap"/><origin rpy="0 0 1.5"/></joint>
</robot>)";

Cell cell_of(const std::string& text) {
  return parse_cell({"test",
                     R"({"urdf": "cell.urdf", "stock": {"link": "table", "size_m": 0.08, "origin_m": [0, 0, 0]},
      "tool": {"link": "nose", "stickout_m": 0.12, "ball_radius_voxels": 0.45, "shank_radius_voxels": 0.4,
               "holder": [{"length_m": 0.02, "radius_m": 0.01, "end_radius_m": 0.002}]}, "home": {}})",
                     {{"cell.urdf", text}, {"tip.obj", tetrahedron}}});
}

Joint& joint(Cell& cell, const std::string& name) {
  return cell.robot.joints.at(static_cast<std::size_t>(cell.robot.find_joint(name)));
}

Link& link(Cell& cell, const std::string& name) {
  return cell.robot.links.at(static_cast<std::size_t>(cell.robot.find_link(name)));
}

TEST(UrdfDifferences, ThereAreNoneInWhatTheLoaderReads) {
  EXPECT_EQ(urdf_differences(cell_of(urdf)), std::vector<std::string>{});
}

TEST(UrdfDifferences, AWrongAxisIsNamedWithBothValues) {
  Cell cell = cell_of(urdf);
  joint(cell, "a3").axis = Vec3(1, 0, 0);
  EXPECT_EQ(urdf_differences(cell),
            std::vector<std::string>{"joint 'a3': the URDF says axis 0 1 0, the loaded cell has 1 0 0"});
}

TEST(UrdfDifferences, WhateverTheLoaderGetsWrongIsFound) {
  const std::vector<std::pair<std::string, std::function<void(Cell&)>>> mistakes{
      {"kind", [](Cell& cell) { joint(cell, "a4").kind = JointKind::prismatic; }},
      {"fixed", [](Cell& cell) { joint(cell, "lid").kind = JointKind::revolute; }},
      {"parent", [](Cell& cell) { joint(cell, "lid").parent_link = cell.robot.find_link("arm"); }},
      {"child", [](Cell& cell) { std::swap(joint(cell, "lid").child_link, joint(cell, "f").child_link); }},
      {"place", [](Cell& cell) { joint(cell, "a3").origin.translation().z() += 1e-6; }},
      {"turn", [](Cell& cell) { joint(cell, "a3").origin.rotate(Eigen::AngleAxisd(1e-6, Vec3::UnitX())); }},
      {"way", [](Cell& cell) { joint(cell, "f").axis = Vec3(0, 0.8, 0.6); }},
      {"default axis", [](Cell& cell) { joint(cell, "x").axis = Vec3::UnitZ(); }},
      {"lower", [](Cell& cell) { joint(cell, "a4").lower = -1.001; }},
      {"upper", [](Cell& cell) { joint(cell, "a3").upper = 7; }},
      {"limit of the leader",
       [](Cell& cell) {
         joint(cell, "x").lower = -0.1;
         joint(cell, "x").upper = 0.2;
       }},
      {"follows", [](Cell& cell) { joint(cell, "g").mimic = cell.robot.find_joint("a4"); }},
      {"multiplier", [](Cell& cell) { joint(cell, "g").mimic_multiplier = 6; }},
      {"offset", [](Cell& cell) { joint(cell, "g").mimic_offset = 0; }},
      {"shape's kind", [](Cell& cell) { link(cell, "arm").shapes[1].kind = ShapeKind::box; }},
      {"shape's place", [](Cell& cell) { link(cell, "table").shapes[0].pose.translation().y() = -0.04; }},
      {"shape's turn", [](Cell& cell) { link(cell, "arm").shapes[0].pose.linear().transposeInPlace(); }},
      {"sphere", [](Cell& cell) { link(cell, "arm").shapes[0].radius_m = 0.005; }},
      {"radius", [](Cell& cell) { link(cell, "arm").shapes[1].radius_m = 0.01; }},
      {"length", [](Cell& cell) { link(cell, "arm").shapes[1].length_m = 0.15; }},
      {"sides", [](Cell& cell) { link(cell, "table").shapes[0].sides_m /= 2; }},
      {"file", [](Cell& cell) { link(cell, "nose").shapes[0].mesh_file = "top.obj"; }},
      {"scale", [](Cell& cell) { link(cell, "nose").shapes[0].mesh_scale = Vec3::Ones(); }},
      {"shape that is not there", [](Cell& cell) { link(cell, "arm").shapes.pop_back(); }},
      {"shape of the tool's link",
       [](Cell& cell) { link(cell, "nose").shapes.erase(link(cell, "nose").shapes.begin()); }},
      {"holder too thin", [](Cell& cell) { link(cell, "nose").shapes[3].radius_m -= 1e-4; }},
      {"holder too short", [](Cell& cell) { link(cell, "nose").shapes.pop_back(); }},
      {"holder that is not there", [](Cell& cell) { link(cell, "nose").shapes.resize(1); }},
      {"sections that slide into each other",
       [](Cell& cell) { link(cell, "nose").shapes[2].pose.translation().z() -= 1e-4; }},
      {"holder beside the axis", [](Cell& cell) { link(cell, "nose").shapes[1].pose.translation().x() = 1e-4; }},
      {"holder of a ball", [](Cell& cell) { link(cell, "nose").shapes[1].kind = ShapeKind::sphere; }},
      {"one too many", [](Cell& cell) { link(cell, "cap").shapes.push_back(box_shape(Vec3::Zero(), Vec3::Ones())); }},
      {"link's name", [](Cell& cell) { link(cell, "cap").name = "lid"; }},
      {"joint's name", [](Cell& cell) { joint(cell, "lid").name = "cap"; }},
  };
  for (const auto& [what, make] : mistakes) {
    Cell cell = cell_of(urdf);
    make(cell);
    EXPECT_FALSE(urdf_differences(cell).empty()) << what;
  }
}

TEST(UrdfDifferences, AreFindingsOfTheReplay) {
  const std::string text =
      R"(<robot name="gantry"><link name="table"/><link name="bridge"/><link name="carriage"/><link name="spindle"/>
    <joint name="x" type="prismatic"><parent link="table"/><child link="bridge"/><axis xyz="1 0 0"/><limit lower="-0.1" upper="0.2" velocity="1" effort="1"/></joint>
    <joint name="y" type="prismatic"><parent link="bridge"/><child link="carriage"/><axis xyz="0 1 0"/><limit lower="-0.1" upper="0.4" velocity="1" effort="1"/></joint>
    <joint name="z" type="prismatic"><parent link="carriage"/><child link="spindle"/><origin xyz="0 0 0.12" rpy="3.141592653589793 0 0"/>
      <axis xyz="0 0 -1"/><limit lower="-0.01" upper="0.3" velocity="1" effort="1"/></joint></robot>)";
  Cell cell = parse_cell({"gantry",
                          R"({"urdf": "g.urdf", "stock": {"link": "table", "size_m": 0.08, "origin_m": [0, 0, 0]},
      "tool": {"link": "spindle", "stickout_m": 0.12, "ball_radius_voxels": 0.45}, "home": {"z": 0.15}})",
                          {{"g.urdf", text}}});
  const VoxelGrid empty{VoxelSet(8), VoxelSet(8)};
  GantryProgram program(cell, 8);
  program.go_home();
  const Verdict good = verify_text(program.text(), cell, empty);
  EXPECT_TRUE(good.clean) << sentences(good);
  joint(cell, "y").axis = Vec3::UnitX();
  EXPECT_TRUE(found(verify_text(program.text(), cell, empty), {"joint 'y'", "axis 0 1 0", "has 1 0 0"}));
  cell.urdf.resize(cell.urdf.size() / 2);
  EXPECT_TRUE(found(verify_text(program.text(), cell, empty), {"cannot read the cell's URDF"}));
}

TEST(UrdfText, WhatCannotBeReadIsRefusedWithItsLine) {
  const auto expect_refused = [](const std::string& good, const std::string& bad, const std::string& words) {
    std::string text = urdf;
    ASSERT_NE(text.find(good), std::string::npos);
    text.replace(text.find(good), good.size(), bad);
    try {
      read_urdf_text(text);
      ADD_FAILURE() << bad;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  expect_refused("0 2 0", "0 2", "<axis> in line 11");
  expect_refused("0 2 0", "0 2 zero", "no number");
  expect_refused("0 2 0", "0 2 0 1", "should be 3 numbers");
  expect_refused("0 2 0", "0 2 0x1", "no number");
  expect_refused("radius=\"0.01\"", "", "has no radius");
  expect_refused("<sphere", "<globe", "is no shape");
  expect_refused("<parent link=\"arm\"/>", "", "has no <parent>");
  expect_refused("link name=\"cap\"", "link name=\"arm\"", "another one has");
  expect_refused("</robot>", "", "no XML");
  expect_refused("<robot name", "<xacro name", "no XML");
}

TEST(UrdfDifferences, CellsThatComeWithTheProgramHaveNone) {
  namespace fs = std::filesystem;
  for (const fs::path& folder : {fs::path(SOURCE_DIR "/config/cells"), fs::path(SOURCE_DIR "/../shared/data/cells")}) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() != ".json") continue;
      EXPECT_EQ(urdf_differences(parse_cell(read_cell_files(entry.path()))), std::vector<std::string>{})
          << entry.path();
    }
  }
}

}  // namespace
}  // namespace sculpt
