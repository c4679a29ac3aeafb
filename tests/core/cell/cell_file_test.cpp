// Every field of a cell file and what is said of a wrong one; a few lines above 300, like what it tests.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/base/error.hpp"
#include "core/cell/shipped_cells.hpp"
#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

const std::string urdf = R"(<robot name="r"><link name="room"/><link name="head"/>
  <joint name="lift" type="prismatic"><parent link="room"/><child link="head"/><axis xyz="0 0 1"/>
  <limit lower="0.1" upper="0.5" velocity="1" effort="1"/></joint></robot>)";

const std::string good = R"({"urdf": "r.urdf", "stock": {"link": "room", "size_m": 0.2, "origin_m": [1, 2, 3]},
  "tool": {"link": "head", "stickout_m": 0.1, "ball_radius_voxels": 0.4, "shank_radius_voxels": 0.3}, "home": {"lift": 0.2}})";

/// `text` with its one occurrence of `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// Code and sentence with which a cell file is refused.
std::string refusal(const std::string& cell_json, const std::string& robot = urdf) {
  try {
    parse_cell({"test", cell_json, {{"r.urdf", robot}}});
    return "accepted";
  } catch (const InputError& error) {
    return error.code() + ": " + error.what();
  }
}

void expect_refused(const std::string& cell_json, const std::string& where, const std::string& word) {
  SCOPED_TRACE(cell_json);
  const std::string said = refusal(cell_json);
  EXPECT_TRUE(said.starts_with("cell_invalid: ")) << said;
  EXPECT_NE(said.find(where), std::string::npos) << said;
  EXPECT_NE(said.find(word), std::string::npos) << said;
}

std::string read_all(const std::filesystem::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}

TEST(CellFile, EveryFieldArrives) {
  const Cell cell = parse_cell({"test", good, {{"r.urdf", urdf}}});
  EXPECT_EQ(cell.name, "test");
  EXPECT_EQ(cell.stock_size_m, 0.2);
  EXPECT_EQ(cell.stock_origin_m, Vec3(1, 2, 3));
  EXPECT_EQ(cell.robot.links[static_cast<std::size_t>(cell.stock_link)].name, "room");
  EXPECT_EQ(cell.robot.links[static_cast<std::size_t>(cell.tool_link)].name, "head");
  EXPECT_TRUE(cell.tool.in_voxels);
  EXPECT_EQ(cell.tool.ball_radius, 0.4);
  EXPECT_EQ(cell.tool.shank_radius, 0.3);
  EXPECT_EQ(cell.tool.stickout_m, 0.1);
  EXPECT_EQ(cell.rest, std::vector<double>{0.2});
  EXPECT_EQ(cell.grid(8).voxel_m, 0.025);
  const Cell metres =
      parse_cell({"test",
                  with(with(good, "ball_radius_voxels", "ball_radius_m"), "shank_radius_voxels", "shank_radius_m"),
                  {{"r.urdf", urdf}}});
  EXPECT_FALSE(metres.tool.in_voxels);
  EXPECT_EQ(parse_cell({"test", with(good, "{\"urdf\"", "{\"name\": \"mine\", \"urdf\""), {{"r.urdf", urdf}}}).name,
            "mine");
}

TEST(CellFile, JointsLeftOutOfHomeStandAsNearToZeroAsTheyCan) {
  EXPECT_EQ(parse_cell({"test", with(good, "\"lift\": 0.2", ""), {{"r.urdf", urdf}}}).rest, std::vector<double>{0.1});
}

/// `good` with pairs of links.
std::string with_pairs(const std::string& ignore, const std::string& check) {
  return with(good, "\"home\"", "\"ignore_pairs\": " + ignore + ", \"check_pairs\": " + check + ", \"home\"");
}

TEST(CellFile, PairsOfLinksArriveAsIndicesInOrderAndOnce) {
  const Cell plain = parse_cell({"test", good, {{"r.urdf", urdf}}});
  EXPECT_TRUE(plain.ignore_pairs.empty());
  EXPECT_TRUE(plain.check_pairs.empty());
  const int room = plain.robot.find_link("room"), head = plain.robot.find_link("head");
  const std::vector<LinkPair> both{{std::min(room, head), std::max(room, head)}};
  const std::string either_way = R"([["head", "room"], ["room", "head"]])";
  EXPECT_EQ(parse_cell({"test", with_pairs(either_way, "[]"), {{"r.urdf", urdf}}}).ignore_pairs, both);
  EXPECT_EQ(parse_cell({"test", with_pairs("[]", either_way), {{"r.urdf", urdf}}}).check_pairs, both);
}

TEST(CellFile, PairsOfLinksThatCannotBeMeantAreRefused) {
  expect_refused(with_pairs(R"([["room", "haed"]])", "[]"), "/ignore_pairs/0/1", "no link 'haed'; its links are");
  expect_refused(with_pairs("[]", R"([["room", "head"], ["rom", "head"]])"), "/check_pairs/1/0", "'rom'");
  expect_refused(with_pairs(R"([["room"]])", "[]"), "/ignore_pairs/0", "two names");
  expect_refused(with_pairs(R"([["head", "head"]])", "[]"), "/ignore_pairs/0", "'head' twice");
  expect_refused(with_pairs(R"(["room", "head"])", "[]"), "/ignore_pairs/0", "array");
  expect_refused(with_pairs(R"({"room": "head"})", "[]"), "/ignore_pairs", "array");
  expect_refused(with_pairs(R"([["head", "room"]])", R"([["room", "head"]])"), "/check_pairs",
                 "'room' and 'head' stand in ignore_pairs as well");
}

TEST(CellFile, UnknownAndMissingFieldsAreNamedByTheirPointer) {
  expect_refused(with(good, "\"stock\"", "\"stok\""), "/stok", "stock");
  expect_refused(with(good, "\"size_m\"", "\"size\""), "/stock/size", "size_m");
  expect_refused(with(good, "\"stickout_m\"", "\"stickout\""), "/tool/stickout", "stickout_m");
  expect_refused(with(good, "\"urdf\": \"r.urdf\", ", ""), "/urdf", "missing");
  expect_refused(with(good, ", \"origin_m\": [1, 2, 3]", ""), "/stock/origin_m", "missing");
  expect_refused(with(good, ", \"home\": {\"lift\": 0.2}", ""), "/home", "missing");
  expect_refused(with(good, "\"ball_radius_voxels\": 0.4, \"shank_radius_voxels\": 0.3", "\"shank_radius_m\": 1"),
                 "/tool", "ball_radius");
}

TEST(CellFile, WrongTypesAndValuesAreNamedByTheirPointer) {
  expect_refused("[]", "top level", "object");
  expect_refused(with(good, "\"r.urdf\"", "7"), "/urdf", "text");
  expect_refused(with(good, "0.2, \"origin", "\"0.2\", \"origin"), "/stock/size_m", "number");
  expect_refused(with(good, "0.2, \"origin", "0, \"origin"), "/stock/size_m", "at least");
  expect_refused(with(good, "0.2, \"origin", "1e300, \"origin"), "/stock/size_m", "metres");
  expect_refused(with(good, "[1, 2, 3]", "[1, 1e300, 3]"), "/stock/origin_m/1", "metres");
  expect_refused(with(good, "[1, 2, 3]", "[1, 2]"), "/stock/origin_m", "three");
  expect_refused(with(good, "[1, 2, 3]", "[1, 2, null]"), "/stock/origin_m/2", "number");
  expect_refused(with(good, "\"stickout_m\": 0.1", "\"stickout_m\": -1"), "/tool/stickout_m", "at least");
  expect_refused(with(good, "\"stickout_m\": 0.1", "\"stickout_m\": 2700"), "/tool/stickout_m", "metres");
  expect_refused(with(good, "\"ball_radius_voxels\": 0.4", "\"ball_radius_voxels\": 0"), "/tool", "above 0");
  expect_refused(with(good, "\"shank_radius_voxels\": 0.3", "\"shank_radius_voxels\": 0.45"), "/tool", "thicker");
  expect_refused(with(good, "\"shank_radius_voxels\": 0.3", "\"shank_radius_m\": 0.001"), "/tool/shank_radius_m",
                 "both");
  expect_refused(with(good, "{\"lift\": 0.2}", "[0.2]"), "/home", "object");
}

std::string with_holder(const std::string& holder) {
  return with(good, "\"stickout_m\": 0.1", "\"stickout_m\": 0.1, \"holder\": " + holder);
}

TEST(CellFile, HolderBecomesPartOfTheToolLink) {
  const Cell cell = parse_cell({"test",
                                with_holder(R"([{"length_m": 0.04, "radius_m": 0.02},
                                               {"length_m": 0.01, "radius_m": 0.02, "end_radius_m": 0.017}])"),
                                {{"r.urdf", urdf}}});
  ASSERT_EQ(cell.tool.holder.size(), 2u);
  EXPECT_EQ(cell.tool.holder[0].end_radius_m, 0.02) << "a cylinder unless told otherwise";
  EXPECT_EQ(cell.tool.holder[1].end_radius_m, 0.017);
  const std::vector<Shape>& shapes = cell.robot.links[static_cast<std::size_t>(cell.tool_link)].shapes;
  ASSERT_EQ(shapes.size(), 3u) << "3 mm of taper is two steps";
  double end_m = 0;
  for (const Shape& shape : shapes) {
    EXPECT_EQ(shape.kind, ShapeKind::cylinder);
    EXPECT_NEAR(shape.pose.translation().z() - shape.length_m / 2, end_m, 1e-12);
    end_m = shape.pose.translation().z() + shape.length_m / 2;
  }
  EXPECT_NEAR(end_m, 0.05, 1e-12);
}

TEST(CellFile, ImpossibleHoldersAreNamedByTheirPointer) {
  expect_refused(with_holder("{}"), "/tool/holder", "array");
  expect_refused(with_holder("[3]"), "/tool/holder/0", "object");
  expect_refused(with_holder(R"([{"radius_m": 0.02}])"), "/tool/holder/0/length_m", "missing");
  expect_refused(with_holder(R"([{"length_m": 0.02}])"), "/tool/holder/0/radius_m", "missing");
  expect_refused(with_holder(R"([{"length_m": 0, "radius_m": 0.02}])"), "/tool/holder/0/length_m", "at least");
  expect_refused(with_holder(R"([{"length_m": 0.02, "radius_m": -1}])"), "/tool/holder/0/radius_m", "at least");
  expect_refused(with_holder(R"([{"length_m": 0.02, "radius_m": 0.02, "end_radius_m": 0}])"),
                 "/tool/holder/0/end_radius_m", "at least");
  expect_refused(with_holder(R"([{"length_m": 0.02, "radius_m": 0.02, "radius_end_m": 1}])"),
                 "/tool/holder/0/radius_end_m", "end_radius_m");
  const std::string half = R"({"length_m": 0.05, "radius_m": 0.02})";
  expect_refused(with_holder("[" + half + ", " + half + "]"), "/tool/holder", "stickout_m");
  std::string many = half;
  for (int i = 0; i < 16; ++i) many += ", " + half;
  expect_refused(with_holder("[" + many + "]"), "/tool/holder", "at most 16");
}

TEST(CellFile, LinksAndJointsThatDoNotExistAreNamedWithThoseThatDo) {
  expect_refused(with(good, "\"room\"", "\"rom\""), "/stock/link", "room, head");
  expect_refused(with(good, "\"head\"", "\"hed\""), "/tool/link", "room, head");
  expect_refused(with(good, "\"lift\"", "\"lft\""), "/home/lft", "no such joint");
  expect_refused(with(good, "\"lift\": 0.2", "\"lift\": 0.6"), "/home/lift", "0.1 to 0.5");
}

TEST(CellFile, HomeOfFixedAndFollowingJointsIsRefused) {
  const std::string more = with(urdf, "</robot>", R"(<link name="x"/><link name="y"/>
    <joint name="bolt" type="fixed"><parent link="room"/><child link="x"/></joint>
    <joint name="twin" type="prismatic"><parent link="room"/><child link="y"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" velocity="1" effort="1"/><mimic joint="lift"/></joint></robot>)");
  EXPECT_NE(refusal(with(good, "\"lift\"", "\"bolt\""), more).find("fixed"), std::string::npos);
  EXPECT_NE(refusal(with(good, "\"lift\"", "\"twin\""), more).find("'lift'"), std::string::npos);
}

TEST(CellFile, ToolsAreChangedAtHomeOrWhereTheFileSays) {
  const auto change = [](const std::string& cell_json) {
    const Cell cell = parse_cell({"test", cell_json, {{"r.urdf", urdf}}});
    return cell.change_place(cell.chain())[0];
  };
  const auto saying = [](const std::string& posture) {
    return with(good, "\"home\"", "\"tool_change\": " + posture + ", \"home\"");
  };
  EXPECT_EQ(change(good), 0.2);
  EXPECT_EQ(change(saying("{}")), 0.2);
  EXPECT_EQ(change(saying("{\"lift\": 0.4}")), 0.4);
  expect_refused(saying("{\"lift\": 0.6}"), "/tool_change/lift", "0.1 to 0.5");
  expect_refused(saying("{\"lft\": 0.4}"), "/tool_change/lft", "no such joint");
  expect_refused(saying("[0.4]"), "/tool_change", "object");
  const std::string beside = with(urdf, "</robot>", R"(<link name="x"/>
    <joint name="door" type="prismatic"><parent link="room"/><child link="x"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" velocity="1" effort="1"/></joint></robot>)");
  EXPECT_NE(refusal(saying("{\"door\": 0.5}"), beside).find("does not move the tool"), std::string::npos);
}

TEST(CellFile, ToolThatNothingMovesIsRefused) {
  EXPECT_TRUE(refusal(with(good, "\"head\"", "\"room\"")).starts_with("chain_empty"));
}

TEST(CellFile, BrokenJsonIsRefusedWithItsLine) {
  expect_refused(good.substr(0, good.size() - 2), "not valid JSON", "line 2");
  expect_refused("", "not valid JSON", "line 1");
  expect_refused("\xff\xfe\x01", "not valid JSON", "line 1");
  expect_refused(std::string(100000, '['), "nests", "16");
}

TEST(CellFile, MalformedUrdfKeepsItsOwnCode) {
  EXPECT_TRUE(refusal(good, "<robot").starts_with("urdf_invalid"));
}

TEST(CellFile, FileThatWasNotSentAlongIsNamed) {
  try {
    parse_cell({"test", good, {}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "file_missing");
    EXPECT_NE(std::string(error.what()).find("'r.urdf'"), std::string::npos);
  }
}

TEST(CellFile, NamesAreLookedUpInOrderAndPathsAreTaken) {
  const TemporaryFolder first, second;
  first.write("a.json", "");
  second.write("a.json", "");
  second.write("b.json", "");
  const std::vector<std::filesystem::path> folders{first.path(), second.path() / "none", second.path()};
  EXPECT_EQ(find_cell("a", folders), first.path() / "a.json");
  EXPECT_EQ(find_cell("b", folders), second.path() / "b.json");
  EXPECT_EQ(find_cell("some/where", folders), "some/where");
  EXPECT_EQ(find_cell("c.json", folders), "c.json");
  try {
    find_cell("c", folders);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "cell_unknown");
    EXPECT_NE(std::string(error.what()).find("a, b"), std::string::npos) << error.what();
  }
}

TEST(CellFile, MissingFilesAreRefusedByName) {
  const TemporaryFolder folder;
  const auto code_of = [&](const std::string& name) {
    try {
      read_cell_files(folder.path() / name);
      return std::string("accepted");
    } catch (const InputError& error) {
      return error.code();
    }
  };
  EXPECT_EQ(code_of("nothing.json"), "file_missing");
  folder.write("cell.json", good);
  EXPECT_EQ(code_of("cell.json"), "file_missing") << "the URDF is missing";
  folder.write("r.urdf",
               with(urdf, "<link name=\"room\"/>",
                    "<link name='room'><collision><geometry><mesh filename='m.obj'/></geometry></collision></link>"));
  EXPECT_EQ(code_of("cell.json"), "file_missing") << "the mesh is missing";
  folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  EXPECT_EQ(code_of("cell.json"), "accepted");
  EXPECT_EQ(code_of("."), "file_missing") << "a folder is no file";
}

TEST(CellFile, PackagesAreFoundByMapAboveTheUrdfAndInTheRosPath) {
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string robot = with(urdf, "<link name=\"room\"/>",
                                 "<link name='room'><collision><geometry><mesh "
                                 "filename='package://my_robot/meshes/m.obj'/></geometry></collision></link>");
  const auto expect_found = [](const TemporaryFolder& folder, const std::string& cell) {
    const CellFiles files = read_cell_files(folder.path() / cell);
    EXPECT_EQ(files.files.count("package://my_robot/meshes/m.obj"), 1u);
    EXPECT_EQ(parse_cell(files).robot.links[0].shapes.size(), 1u);
  };
  const TemporaryFolder mapped;
  mapped.write("cell.json", with(good, "{\"urdf\"", "{\"packages\": {\"my_robot\": \"elsewhere\"}, \"urdf\""));
  mapped.write("r.urdf", robot);
  mapped.write("elsewhere/meshes/m.obj", mesh);
  expect_found(mapped, "cell.json");

  const TemporaryFolder above;
  above.write("cell.json", with(good, "r.urdf", "my_robot/urdf/r.urdf"));
  above.write("my_robot/urdf/r.urdf", robot);
  above.write("my_robot/meshes/m.obj", mesh);
  expect_found(above, "cell.json");

  const TemporaryFolder ros, plain;
  ros.write("my_robot/meshes/m.obj", mesh);
  plain.write("cell.json", good);
  plain.write("r.urdf", robot);
  EXPECT_THROW(read_cell_files(plain.path() / "cell.json"), InputError);
  setenv("ROS_PACKAGE_PATH", ("/nowhere:" + ros.path().string()).c_str(), 1);
  expect_found(plain, "cell.json");
  unsetenv("ROS_PACKAGE_PATH");
}

TEST(CellFile, PandaWithMeshLinksFromItsRosPackageWorks) {
  const char* shared = std::getenv("SCULPT_SHARED_DATA");
  const std::filesystem::path package =
      std::filesystem::path(shared ? shared : SOURCE_DIR "/../shared/data") / "ros/moveit_resources_panda_description";
  if (!std::filesystem::exists(package)) GTEST_SKIP() << "no shared data at " << package;

  const TemporaryFolder folder;
  folder.write("panda.urdf", read_all(package / "urdf/panda.urdf"));
  folder.write("cell.json", R"({"urdf": "panda.urdf", "packages": {"moveit_resources_panda_description": ")" +
                                package.string() + R"("},
    "stock": {"link": "panda_link0", "size_m": 0.1, "origin_m": [0.5, -0.05, 0.1]},
    "tool": {"link": "panda_hand", "stickout_m": 0.2, "ball_radius_m": 0.002, "shank_radius_m": 0.001},
    "home": {"panda_joint2": -0.5, "panda_joint4": -2.2, "panda_joint6": 1.7, "panda_finger_joint1": 0.01}})");
  const CellFiles files = read_cell_files(folder.path() / "cell.json");
  EXPECT_EQ(files.files.size(), 1u + 10) << "the URDF, eight arm links, hand and finger";
  const Cell cell = parse_cell(files);
  const Chain chain = cell.chain();
  EXPECT_EQ(chain.dof(), 7) << "fingers are off the path";
  std::size_t triangles = 0;
  for (const Link& link : cell.robot.links) {
    for (const Shape& shape : link.shapes) triangles += shape.mesh ? shape.mesh->triangles.size() : 0;
  }
  EXPECT_GT(triangles, 2000u);
  const int follower = cell.robot.find_joint("panda_finger_joint2");
  EXPECT_EQ(cell.rest[static_cast<std::size_t>(follower)], 0.01);
  const ToolPose pose = chain.tool_pose(cell.home(chain));
  EXPECT_NEAR(pose.axis.z(), 1, 1e-9) << "-0.5 + 2.2 = 1.7: the hand looks straight down";
}

}  // namespace
}  // namespace sculpt
