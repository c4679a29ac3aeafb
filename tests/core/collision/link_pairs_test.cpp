#include "core/collision/link_pairs.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/collision/scene.hpp"
#include "core/collision/shape/shape_contact.hpp"
#include "tests/core/collision/small_arm.hpp"

namespace sculpt {
namespace {

std::string box(const std::string& at, const std::string& sides) {
  return "<collision><origin xyz=\"" + at + "\"/><geometry><box size=\"" + sides + "\"/></geometry></collision>";
}

std::string link(const std::string& name, const std::string& shapes) {
  return "<link name=\"" + name + "\">" + shapes + "</link>";
}

std::string joint(const std::string& name, const std::string& kind, const std::string& parent, const std::string& child,
                  const std::string& at, const std::string& axis, double low, double high) {
  return "<joint name=\"" + name + "\" type=\"" + kind + "\"><parent link=\"" + parent + "\"/><child link=\"" + child +
         "\"/><origin xyz=\"" + at + "\"/><axis xyz=\"" + axis + "\"/><limit lower=\"" + std::to_string(low) +
         "\" upper=\"" + std::to_string(high) + "\" effort=\"1\" velocity=\"1\"/></joint>";
}

Cell make_cell(const std::string& robot, const std::string& home, const std::string& fields = "") {
  CellFiles files;
  files.name = "pairs";
  files.cell_json = R"({"urdf": "r.urdf", "stock": {"link": "room", "size_m": 0.1, "origin_m": [-0.05, -0.05, 0]},
    "tool": {"link": "ram", "stickout_m": 0.1, "ball_radius_voxels": 0.45}, "home": {)" +
                    home + "}" + fields + "}";
  files.files["r.urdf"] = "<robot name=\"pairs\">" + robot + "</robot>";
  return parse_cell(files);
}

/// The issue's gantry: a ram of 40 mm in a hole of 160 mm of a fixed plate, on axes of +-0.8 m.
std::string ram_in_plate() {
  return link("room", "") +
         link("plate", box("0.54 0 0", "0.92 2 0.03") + box("-0.54 0 0", "0.92 2 0.03") +
                           box("0 0.54 0", "0.16 0.92 0.03") + box("0 -0.54 0", "0.16 0.92 0.03")) +
         "<joint name=\"bolts\" type=\"fixed\"><parent link=\"room\"/><child link=\"plate\"/><origin xyz=\"0 0 "
         "0.4\"/></joint>" +
         link("bridge", "") + link("carriage", "") + link("ram", box("0 0 -0.5", "0.04 0.04 1")) +
         joint("x", "prismatic", "room", "bridge", "0 0 0.3", "1 0 0", -0.8, 0.8) +
         joint("y", "prismatic", "bridge", "carriage", "0 0 0", "0 1 0", -0.8, 0.8) +
         "<joint name=\"z\" type=\"prismatic\"><parent link=\"carriage\"/><child link=\"ram\"/><origin "
         "rpy=\"3.14159265 "
         "0 0\"/><axis xyz=\"0 0 1\"/><limit lower=\"0\" upper=\"0.2\" effort=\"1\" velocity=\"1\"/></joint>";
}

/// A hinge with a bar whose end is a ball in its bearing, and another link two joints away from the room.
std::string hinged_bar(const std::string& room) {
  const std::string ball = "<collision><geometry><sphere radius=\"0.05\"/></geometry></collision>";
  return link("room", ball + room) + link("bar", ball + box("0.3 0 0", "0.5 0.04 0.04")) +
         link("ram", box("0 0 0", "0.03 0.03 0.03")) +
         joint("hinge", "revolute", "room", "bar", "0 0 0", "0 0 1", -3, 3) +
         joint("wrist", "revolute", "bar", "ram", "0.7 0 0", "0 1 0", -1, 1);
}

/// Is the pair left out? With which reason.
std::string why_left_out(const Cell& cell, const LinkPairs& pairs, const char* a, const char* b) {
  for (const UncheckedLinks& pair : pairs.unchecked)
    if (pair.links == LinkPair(std::minmax(cell.robot.find_link(a), cell.robot.find_link(b)))) return pair.why;
  return "";
}

/// Numbers of the shapes that are kept apart.
std::vector<std::pair<std::size_t, std::size_t>> shapes_checked(const Cell& cell, const LinkPairs& pairs, const char* a,
                                                                const char* b) {
  for (const CheckedLinks& pair : pairs.checked)
    if (pair.links == LinkPair(std::minmax(cell.robot.find_link(a), cell.robot.find_link(b)))) return pair.shapes;
  return {};
}

using Numbers = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(LinkPairs, ARamThatIsFreeInItsHoleAtHomeIsKeptOutOfThePlate) {
  const Cell cell = make_cell(ram_in_plate(), R"("z": 0.1)");
  const LinkPairs pairs = find_link_pairs(cell);
  const Numbers all{{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  EXPECT_EQ(shapes_checked(cell, pairs, "plate", "ram"), all);
  EXPECT_TRUE(pairs.unchecked.empty());
  const Scene scene(cell, cell.grid(8), VoxelSet(8));
  EXPECT_EQ(scene.contact_at(Eigen::Vector3d(0, 0, 0.1)), Contact::none);
  EXPECT_EQ(scene.contact_at(Eigen::Vector3d(0.1, 0, 0.1)), Contact::link_link);
  EXPECT_NE(scene.certify(Eigen::Vector3d(0, 0, 0.1), Eigen::Vector3d(0.1, 0, 0.1)), Contact::none);
  EXPECT_EQ(scene.certify(Eigen::Vector3d(0, 0, 0.1), Eigen::Vector3d(0.05, 0.05, 0.2)), Contact::none);
}

TEST(LinkPairs, NeighboursThatAreApartAtHomeAreKeptApartAndABearingIsNot) {
  const Cell cell = make_cell(hinged_bar(box("0 0.4 0", "0.1 0.1 0.1")), R"("hinge": 0)");
  const LinkPairs pairs = find_link_pairs(cell);
  // The room's ball and both parts of the bar meet at the hinge; the post is free of both.
  EXPECT_EQ(shapes_checked(cell, pairs, "room", "bar"), (Numbers{{1, 0}, {1, 1}}));
  EXPECT_EQ(why_left_out(cell, pairs, "room", "bar"), "neighbours that touch at the joint");
  EXPECT_EQ(shapes_checked(cell, pairs, "room", "ram"), (Numbers{{0, 0}, {1, 0}}));
  EXPECT_EQ(pairs.unchecked.size(), 1u);
  const Scene scene(cell, cell.grid(8), VoxelSet(8));
  EXPECT_EQ(scene.contact_at(Eigen::Vector2d(0, 0)), Contact::none);
  EXPECT_EQ(scene.contact_at(Eigen::Vector2d(1.5, 0)), Contact::link_link);
  EXPECT_NE(scene.certify(Eigen::Vector2d(0, 0), Eigen::Vector2d(3, 0)), Contact::none);
}

TEST(LinkPairs, ABarThatRestsOnAPostAtHomeIsNoBearing) {
  const Cell cell = make_cell(hinged_bar(box("0.4 0.06 0", "0.1 0.1 0.1")), R"("hinge": 0)");
  const Scene scene(cell, cell.grid(8), VoxelSet(8));
  const std::string contact = scene.describe_contact(Eigen::Vector2d(0, 0));
  EXPECT_NE(contact.find("'room'"), std::string::npos) << contact;
  EXPECT_NE(contact.find("'bar'"), std::string::npos) << contact;
  EXPECT_NE(contact.find("\"ignore_pairs\""), std::string::npos) << contact;
  EXPECT_EQ(scene.contact_at(Eigen::Vector2d(-1, 0)), Contact::none);
}

TEST(LinkPairs, TheCellFileOverrulesWhatWasFoundOut) {
  const std::string robot = hinged_bar(box("0 0.4 0", "0.1 0.1 0.1"));
  const Cell ignoring = make_cell(robot, R"("hinge": 0)", R"(, "ignore_pairs": [["bar", "room"]])");
  const LinkPairs ignored = find_link_pairs(ignoring);
  EXPECT_TRUE(shapes_checked(ignoring, ignored, "room", "bar").empty());
  EXPECT_EQ(why_left_out(ignoring, ignored, "room", "bar"), "ignore_pairs");
  const Scene scene(ignoring, ignoring.grid(8), VoxelSet(8));
  EXPECT_EQ(scene.contact_at(Eigen::Vector2d(1.5, 0)), Contact::none);
  const Cell checking = make_cell(robot, R"("hinge": 0)", R"(, "check_pairs": [["room", "bar"]])");
  const LinkPairs checked = find_link_pairs(checking);
  EXPECT_EQ(shapes_checked(checking, checked, "room", "bar").size(), 4u);
  EXPECT_EQ(why_left_out(checking, checked, "room", "bar"), "");
  EXPECT_EQ(Scene(checking, checking.grid(8), VoxelSet(8)).contact_at(Eigen::Vector2d(0, 0)), Contact::link_link);
}

/// A hub of radius 0.1 that a cross of two hinges carries, with a ball that its second hinge moves about.
std::string crossed_hinges(const std::string& ball_at, double ball_radius_m) {
  return link("room", "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>") + link("cross", "") +
         link("ram", "<collision><origin xyz=\"" + ball_at + "\"/><geometry><sphere radius=\"" +
                         std::to_string(ball_radius_m) + "\"/></geometry></collision>") +
         joint("pan", "revolute", "room", "cross", "0 0 0", "0 0 1", -3, 3) +
         joint("tilt", "revolute", "cross", "ram", "0.02 0 0", "0 1 0", -3, 3);
}

TEST(LinkPairs, WhatIsProvedToTouchEverywhereIsLeftOut) {
  const Cell cell = make_cell(crossed_hinges("0.05 0 0", 0.06), "");
  const LinkPairs pairs = find_link_pairs(cell);
  EXPECT_TRUE(pairs.checked.empty());
  EXPECT_EQ(why_left_out(cell, pairs, "room", "ram"), "touch in every configuration");
}

TEST(LinkPairs, WhatTouchesAtHomeAndComesApartSomewhereIsAContactAtHome) {
  // The centres are 0.16 m apart at a tilt of 0, 0.12 m at home.
  const Cell cell = make_cell(crossed_hinges("0.14 0 0", 0.04), R"("tilt": 3)");
  const LinkPairs pairs = find_link_pairs(cell);
  EXPECT_EQ(shapes_checked(cell, pairs, "room", "ram"), (Numbers{{0, 0}}));
  const std::string contact = Scene(cell, cell.grid(8), VoxelSet(8)).describe_contact(Eigen::Vector2d(0, 3));
  EXPECT_NE(contact.find("'room' touches 'ram'"), std::string::npos) << contact;
}

/// True if the two shapes of these links touch at q.
bool touch(const Cell& cell, const Chain& chain, const Configuration& q, int a, std::size_t of_a, int b,
           std::size_t of_b) {
  const LinkShape first(a, cell.robot.links[static_cast<std::size_t>(a)].shapes[of_a]);
  const LinkShape second(b, cell.robot.links[static_cast<std::size_t>(b)].shapes[of_b]);
  return ShapeContact(chain, first, second).touch(q);
}

TEST(LinkPairs, APlaceThatOnlyAClimbFindsIsFound) {
  // Two long slides of which only a corner of the travel is free: 0.12 % of it.
  const std::string robot = link("room", box("0 0 0", "1.93 1.93 0.1")) + link("slide", "") +
                            link("ram", box("0 0 0", "0.02 0.02 0.05")) +
                            joint("x", "prismatic", "room", "slide", "0 0 0", "0.8 0.6 0", -1.2, 1.2) +
                            joint("y", "prismatic", "slide", "ram", "0 0 0", "-0.6 0.8 0", -0.4, 0.4);
  const Cell cell = make_cell(robot, "");
  const Chain chain = cell.chain();
  const int room = cell.robot.find_link("room"), ram = cell.robot.find_link("ram");
  ASSERT_TRUE(touch(cell, chain, Eigen::Vector2d(0, 0), room, 0, ram, 0));
  ASSERT_FALSE(touch(cell, chain, Eigen::Vector2d(1.2, -0.4), room, 0, ram, 0));
  EXPECT_EQ(shapes_checked(cell, find_link_pairs(cell), "room", "ram"), (Numbers{{0, 0}}));
}

TEST(LinkPairs, ANarrowGapAtHomeNarrowsTheMarginToIt) {
  // 0.06 mm between the ram and its guide, on both sides.
  const std::string robot = link("room", box("0.07006 0 0", "0.1 0.1 0.2") + box("-0.07006 0 0", "0.1 0.1 0.2")) +
                            link("slide", "") + link("ram", box("0 0 0", "0.04 0.04 0.1")) +
                            joint("z", "prismatic", "room", "slide", "0 0 0", "0 0 1", -0.02, 0.02) +
                            joint("y", "prismatic", "slide", "ram", "0 0 0", "0 1 0", -0.01, 0.01);
  const Cell cell = make_cell(robot, "");
  const Scene scene(cell, cell.grid(8), VoxelSet(8));
  EXPECT_EQ(shapes_checked(cell, find_link_pairs(cell), "room", "ram").size(), 2u);
  EXPECT_EQ(scene.describe_contact(Eigen::Vector2d(0, 0)), "");
  EXPECT_EQ(scene.certify(Eigen::Vector2d(0, 0), Eigen::Vector2d(0.01, 0.005)), Contact::none);
}

TEST(LinkPairs, ASceneKeepsApartWhatIsCheckedAndNothingElse) {
  const Cell cell = make_test_cell();
  const LinkPairs pairs = find_link_pairs(cell);
  const Scene scene(cell, cell.grid(8), VoxelSet(8));
  const Chain& chain = scene.chain();
  int touching = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Configuration q(chain.dof());
    for (int i = 0; i < q.size(); ++i) q[i] = random.between(chain.lower()[i], chain.upper()[i]);
    bool any = false;
    for (const CheckedLinks& links : pairs.checked)
      for (const auto& [a, b] : links.shapes)
        any = any || touch(cell, chain, q, links.links.first, a, links.links.second, b);
    if (!any) continue;
    ++touching;
    EXPECT_EQ(scene.contact_at(q), Contact::link_link);
  }
  EXPECT_GT(touching, 20);
}

TEST(LinkPairs, LinksAcrossABearingAreKeptApartWhereTheyAreApartAtHome) {
  const Cell cell = make_test_cell();
  const LinkPairs pairs = find_link_pairs(cell);
  EXPECT_EQ(why_left_out(cell, pairs, "upper", "fore"), "neighbours that touch at the joint");
  for (const auto& [a, b] : {std::pair("base", "disc"), std::pair("base", "upper"), std::pair("base", "nose"),
                             std::pair("disc", "fore"), std::pair("upper", "nose")}) {
    EXPECT_EQ(shapes_checked(cell, pairs, a, b).size(), 1u) << a << " " << b;
    EXPECT_EQ(why_left_out(cell, pairs, a, b), "") << a << " " << b;
  }
}

}  // namespace
}  // namespace sculpt
