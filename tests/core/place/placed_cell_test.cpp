#include "core/place/placed_cell.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

CellSource read_source(const fs::path& path) {
  CellSource source{read_cell_files(path), path, {}};
  source.cell = parse_cell(source.files);
  return source;
}

/// Writes both files and reads the cell again.
Cell write_and_read(const PlacedCell& placed, const fs::path& to) {
  fs::create_directories(to.parent_path());
  std::ofstream(to) << placed.cell_json;
  std::ofstream(to.parent_path() / placed.urdf_name) << placed.urdf;
  return parse_cell(read_cell_files(to));
}

constexpr const char* tetrahedron =
    "OFF\n4 4 0\n0 0 0\n0.01 0 0\n0 0.01 0\n0 0 0.01\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

/// An arm of one joint with two meshes, one beside the URDF and one of a package.
void write_cell_with_meshes(const TemporaryFolder& folder) {
  fs::create_directories(folder.path() / "robots/parts");
  fs::create_directories(folder.path() / "packages/my_arm/meshes");
  folder.write("robots/parts/hand.off", tetrahedron);
  folder.write("packages/my_arm/meshes/arm.off", tetrahedron);
  folder.write("robots/arm.urdf", R"(<robot name="arm"><link name="room"/>
<link name="arm"><collision><geometry><mesh filename="package://my_arm/meshes/arm.off"/></geometry></collision></link>
<joint name="turn" type="continuous"><parent link="room"/><child link="arm"/><axis xyz="0 0 1"/></joint>
<link name="hand"><collision><geometry><mesh filename="parts/hand.off"/></geometry></collision></link>
<joint name="wrist" type="fixed"><parent link="arm"/><child link="hand"/><origin xyz="0.5 0 0"/></joint>
<link name="stock"/>
<joint name="clamp" type="fixed"><parent link="room"/><child link="stock"/></joint></robot>)");
  folder.write("robots/cell.json", R"({"urdf": "arm.urdf", "packages": {"my_arm": "../packages/my_arm"},
 "stock": {"link": "stock", "size_m": 0.1, "origin_m": [0, 0, 0]},
 "tool": {"link": "hand", "stickout_m": 0.1, "ball_radius_m": 0.001}, "home": {}})");
}

TEST(PlacedCell, InAnotherFolderItsMeshesAreStillFound) {
  const TemporaryFolder folder;
  write_cell_with_meshes(folder);
  const CellSource source = read_source(folder.path() / "robots/cell.json");
  const int joint = find_moved_joint(source.cell, Moved::table);
  Stand stand = stand_of(source.cell, joint);
  stand.at_m = {0.3, 0.1, 0.2};
  stand.turn_rad = 0.25;
  const fs::path to = folder.path() / "elsewhere/deep/placed.json";
  const Cell placed = write_and_read(place_cell(source, joint, stand, {}, to), to);
  const Cell expected = cell_at(source.cell, joint, stand);
  ASSERT_EQ(placed.robot.joints.size(), expected.robot.joints.size());
  for (std::size_t at = 0; at < placed.robot.joints.size(); ++at)
    EXPECT_TRUE(placed.robot.joints[at].origin.isApprox(expected.robot.joints[at].origin, 1e-12));
  for (std::size_t at = 0; at < placed.robot.links.size(); ++at)
    EXPECT_EQ(placed.robot.links[at].shapes.size(), expected.robot.links[at].shapes.size());
}

TEST(PlacedCell, WhatIsNotVariedStaysAsItWasWritten) {
  const fs::path path = SOURCE_DIR "/config/cells/panda-turntable.json";
  const CellSource source = read_source(path);
  const int joint = find_moved_joint(source.cell, Moved::table);
  const PlacedCell placed = place_cell(source, joint, stand_of(source.cell, joint), {}, path.parent_path() / "x.json");
  EXPECT_EQ(placed.urdf, source.files.files.at("../robots/panda-turntable.urdf"));
  auto before = nlohmann::json::parse(source.files.cell_json), after = nlohmann::json::parse(placed.cell_json);
  EXPECT_EQ(after["urdf"], "x.urdf");
  before.erase("urdf");
  after.erase("urdf");
  EXPECT_EQ(after, before);
}

TEST(PlacedCell, HeightToolAndHomeAreWritten) {
  const fs::path path = SOURCE_DIR "/config/cells/panda-turntable.json";
  const CellSource source = read_source(path);
  const int joint = find_moved_joint(source.cell, Moved::table);
  Stand stand = stand_of(source.cell, joint);
  stand.height_m = 0.05;
  stand.stickout_m = 0.2;
  const Chain chain = source.cell.chain();
  Configuration home = source.cell.home(chain);
  home[2] += 0.125;
  const TemporaryFolder folder;
  const fs::path to = folder.path() / "placed.json";
  const Cell placed = write_and_read(place_cell(source, joint, stand, home, to), to);
  EXPECT_EQ(placed.stock_origin_m.z(), 0.05);
  EXPECT_EQ(placed.tool.stickout_m, 0.2);
  EXPECT_TRUE(placed.home(placed.chain()).isApprox(home, 1e-12));
}

}  // namespace
}  // namespace sculpt
