#include "core/cell/robot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"
#include "tests/core/cell/sample_robots.hpp"

namespace sculpt {
namespace {

/// The sentence with which a URDF is refused; "" when it is accepted.
std::string refusal(const std::string& xml) {
  try {
    parse_plain(xml);
    return "";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), "urdf_invalid");
    return error.what();
  }
}

/// Two links and the joint between them.
std::string with_joint(const std::string& type, const std::string& inside) {
  return "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='" + type +
         "'><parent link='a'/><child link='b'/>" + inside + "</joint></robot>";
}

std::string with_shape(const std::string& geometry, const std::string& origin = "") {
  return "<robot name='r'><link name='a'><collision>" + origin + "<geometry>" + geometry +
         "</geometry></collision></link></robot>";
}

const std::string limits = "<limit lower='-1' upper='2' velocity='3' effort='1'/>";

void expect_refused(const std::string& xml, const std::string& word) {
  SCOPED_TRACE(xml);
  const std::string sentence = refusal(xml);
  EXPECT_NE(sentence.find(word), std::string::npos) << "the sentence was: " << sentence;
}

TEST(Robot, AXacroSourceIsRefusedWithTheWayToWriteItOut) {
  expect_refused(R"(<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro"><link name="a"/>
    <xacro:include filename="arm.xacro"/></robot>)",
                 "xacro robot.urdf.xacro > robot.urdf");
  EXPECT_EQ(refusal(R"(<!-- made from <xacro:arm/> --><robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
    <link name="a"/></robot>)"),
            "")
      << "what xacro wrote names it still";
}

TEST(Robot, AMeshThatCannotBeReadIsNamedWithItsLink) {
  const auto said = [](const std::string& file) {
    try {
      parse_urdf(with_shape("<mesh filename='" + file + "'/>"),
                 [](const std::string&) { return std::string("ply\n"); });
    } catch (const InputError& error) {
      EXPECT_EQ(error.code(), "mesh_unreadable");
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(
      said("package://arm/base.DAE").find("mesh 'package://arm/base.DAE' of link 'a': the file is no readable .dae"),
      std::string::npos);
  EXPECT_NE(said("base.ply").find("mesh 'base.ply' of link 'a': the .ply file"), std::string::npos);
}

TEST(Robot, ShapesOfAllKindsAreRead) {
  const Robot robot = parse_plain(R"(<robot name="r"><link name="a">
    <visual><geometry><mesh filename="never-read.stl"/></geometry></visual>
    <collision><origin xyz="1 2 3"/><geometry><box size="1 2 4"/></geometry></collision>
    <collision><geometry><cylinder radius="0.5" length="2"/></geometry></collision>
    <collision><geometry><sphere radius="0.25"/></geometry></collision></link></robot>)");
  ASSERT_EQ(robot.links.size(), 1u);
  const std::vector<Shape>& shapes = robot.links[0].shapes;
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].kind, ShapeKind::box);
  EXPECT_EQ(shapes[0].sides_m, Vec3(1, 2, 4));
  EXPECT_EQ(shapes[0].pose.translation(), Vec3(1, 2, 3));
  EXPECT_EQ(shapes[1].kind, ShapeKind::cylinder);
  EXPECT_EQ(shapes[1].radius_m, 0.5);
  EXPECT_EQ(shapes[1].length_m, 2);
  EXPECT_EQ(shapes[2].kind, ShapeKind::sphere);
  EXPECT_EQ(shapes[2].radius_m, 0.25);
}

TEST(Robot, JointsComeAfterTheirParentsAndKnowTheirLinks) {
  for (const SampleChain& sample : {arm_on_rail(), mimic_machine(), shipped_chain(shipped_cell("panda-turntable"))}) {
    SCOPED_TRACE(sample.title);
    const Robot& robot = sample.robot;
    EXPECT_EQ(robot.links[static_cast<std::size_t>(robot.root)].parent_joint, -1);
    std::vector<bool> placed(robot.links.size(), false);
    placed[static_cast<std::size_t>(robot.root)] = true;
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const Joint& joint = robot.joints[j];
      EXPECT_TRUE(placed[static_cast<std::size_t>(joint.parent_link)]) << joint.name;
      EXPECT_EQ(robot.links[static_cast<std::size_t>(joint.child_link)].parent_joint, static_cast<int>(j));
      placed[static_cast<std::size_t>(joint.child_link)] = true;
      EXPECT_NEAR(joint.axis.norm(), 1, 1e-15);
    }
    EXPECT_EQ(std::count(placed.begin(), placed.end(), false), 0);
  }
}

TEST(Robot, LimitsSpeedsAndContinuousJointsAreRead) {
  const Robot bounded = parse_plain(with_joint("revolute", "<axis xyz='0 0 -2'/>" + limits));
  EXPECT_EQ(bounded.joints[0].lower, -1);
  EXPECT_EQ(bounded.joints[0].upper, 2);
  EXPECT_EQ(bounded.joints[0].max_speed, 3);
  EXPECT_EQ(bounded.joints[0].axis, Vec3(0, 0, -1));
  const Robot endless = parse_plain(with_joint("continuous", "<axis xyz='0 0 1'/>"));
  EXPECT_EQ(endless.joints[0].kind, JointKind::revolute);
  EXPECT_EQ(endless.joints[0].lower, -2 * std::numbers::pi);
  EXPECT_EQ(endless.joints[0].upper, 2 * std::numbers::pi);
}

TEST(Robot, MimicOfAMimicLeadsToTheFreeJoint) {
  const Robot robot = mimic_machine().robot;
  const Joint& nod = robot.joints[static_cast<std::size_t>(robot.find_joint("nod"))];
  EXPECT_EQ(nod.mimic, robot.find_joint("slide"));
  EXPECT_DOUBLE_EQ(nod.mimic_multiplier, -3);
  EXPECT_DOUBLE_EQ(nod.mimic_offset, 0.3 - 2 * 0.02);
}

TEST(Robot, MalformedXmlIsRefusedWithWhatTheParserSaid) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_NE(refusal("<robot name='r'><link name='a'>"), "");
  EXPECT_NE(refusal(""), "");
  EXPECT_NE(refusal("no XML"), "");
  EXPECT_NE(refusal(std::string("\0\x01\xff\xfe<<<>>>", 10)), "");
  expect_refused("<world/>", "robot");
  expect_refused("<robot name='r'></robot>", "link");
  expect_refused("<robot name='r'><link name='a'/><link name='a'/></robot>", "'a'");
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

TEST(Robot, EndlessNestingIsRefusedInsteadOfOverflowingTheStack) {
  std::string deep = "<robot name='r'>";
  for (int i = 0; i < 200000; ++i) deep += "<a>";
  expect_refused(deep, "nests");
  std::string whole = "<robot name='r'><link name='a'><!-- <a> --><![CDATA[ ' \" > ]]></link>", ends;
  for (int i = 0; i < 100; ++i) {
    whole += "<a>";
    ends += "</a>";
  }
  expect_refused(whole + ends + "</robot>", "nests");
  expect_refused(std::string(3u << 20, ' '), "limit");
}

TEST(Robot, TreesThatAreNoTreesAreRefused) {
  expect_refused("<robot name='r'><link name='a'/><link name='b'/></robot>", "root");
  const auto joint = [](const std::string& name, const std::string& from, const std::string& to) {
    return "<joint name='" + name + "' type='fixed'><parent link='" + from + "'/><child link='" + to + "'/></joint>";
  };
  const std::string three = "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>";
  expect_refused(three + joint("1", "a", "b") + joint("2", "b", "nowhere") + "</robot>", "nowhere");
  expect_refused(three + joint("1", "a", "b") + joint("2", "a", "c") + joint("3", "b", "c") + "</robot>", "'c'");
  expect_refused(three + joint("1", "b", "c") + joint("2", "c", "b") + "</robot>", "'b'");
}

TEST(Robot, JointsThatCannotBePlannedAreRefused) {
  expect_refused(with_joint("floating", ""), "floating");
  expect_refused(with_joint("planar", "<axis xyz='0 0 1'/>"), "planar");
  expect_refused(with_joint("ball", ""), "[ball]");
  expect_refused(with_joint("revolute", "<axis xyz='0 0 1'/>"), "j]");
  expect_refused(with_joint("prismatic", "<axis xyz='0 0 1'/><limit velocity='1' effort='1'/>"), "range");
  expect_refused(with_joint("revolute", "<axis xyz='0 0 1'/><limit lower='1' upper='-1' velocity='1' effort='1'/>"),
                 "swap");
  expect_refused(with_joint("revolute", "<axis xyz='0 0 1'/><limit lower='nan' upper='1' velocity='1' effort='1'/>"),
                 "j]");
  expect_refused(
      with_joint("prismatic", "<axis xyz='0 0 1'/><limit lower='-1' upper='1e300' velocity='1' effort='1'/>"),
      "no joint of a robot");
  expect_refused(with_joint("revolute", "<axis xyz='0 0 1'/><limit lower='-1e300' upper='1' velocity='1' effort='1'/>"),
                 "continuous");
  expect_refused(with_joint("revolute", "<axis xyz='0 0 0'/>" + limits), "axis");
  expect_refused(with_joint("revolute", "<axis xyz='nan 0 1'/>" + limits), "j]");
  expect_refused(with_joint("revolute", "<origin xyz='0 inf 0'/><axis xyz='0 0 1'/>" + limits), "j]");
}

TEST(Robot, MimicsThatLeadNowhereAreRefused) {
  expect_refused(with_joint("revolute", "<axis xyz='0 0 1'/>" + limits + "<mimic joint='ghost'/>"), "ghost");
  expect_refused(with_joint("revolute", "<axis xyz='0 0 1'/>" + limits + "<mimic joint='j'/>"), "circle");
  const auto pair = [](const std::string& first, const std::string& mimic) {
    return "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><joint name='lead' " + first +
           "<parent link='a'/><child link='b'/></joint><joint name='follow' type='prismatic'><parent link='b'/><child "
           "link='c'/><axis xyz='0 0 1'/><limit lower='5' upper='6' velocity='1' effort='1'/>" +
           mimic + "</joint></robot>";
  };
  expect_refused(pair("type='fixed'>", "<mimic joint='lead'/>"), "fixed");
  expect_refused(pair("type='prismatic'><axis xyz='0 0 1'/>" + limits, "<mimic joint='lead'/>"), "no range");
}

TEST(Robot, FollowerThatStandsOutsideItsOwnLimitsIsRefused) {
  const auto follower = [](const std::string& offset) {
    return "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>"
           "<joint name='lead' type='prismatic'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/>" +
           limits + "</joint><joint name='follow' type='prismatic'><parent link='b'/><child link='c'/>" +
           "<axis xyz='0 0 1'/><limit lower='-0.1' upper='0.1' velocity='1' effort='1'/>" +
           "<mimic joint='lead' multiplier='0' offset='" + offset + "'/></joint></robot>";
  };
  expect_refused(follower("0.5"), "offset 0.5, outside its limits of -0.1 to 0.1");
  expect_refused(follower("-0.11"), "'follow'");
  EXPECT_EQ(parse_plain(follower("0.1")).joints[1].mimic_offset, 0.1);
}

TEST(Robot, ShapesWithoutASizeAreRefused) {
  expect_refused(with_shape("<box size='1 0 1'/>"), "'a'");
  expect_refused(with_shape("<box size='1 -1 1'/>"), "'a'");
  expect_refused(with_shape("<sphere radius='0'/>"), "'a'");
  expect_refused(with_shape("<sphere radius='nan'/>"), "[a]");
  expect_refused(with_shape("<cylinder radius='1' length='-1'/>"), "'a'");
  expect_refused(with_shape("<sphere radius='1'/>", "<origin xyz='0 0 nan'/>"), "[a]");
  expect_refused(with_shape("<capsule radius='1' length='1'/>"), "capsule");
  expect_refused(with_shape(""), "[a]");
}

TEST(Robot, BodiesInMillimetresAreRefused) {
  expect_refused(with_shape("<cylinder radius='60' length='316'/>"), "metres, not millimetres");
  expect_refused(with_shape("<box size='400 300 1e300'/>"), "metres, not millimetres");
  expect_refused(with_shape("<sphere radius='101'/>"), "'a'");
}

TEST(Robot, NamesThatATerminalWouldSwallowAreRefused) {
  expect_refused("<robot name='r'><link name='a\x1b[2J'/></robot>", "control character 27");
  expect_refused("<!DOCTYPE robot [<!ENTITY a 'b'>]><robot name='r'><link name='&a;'/></robot>", "DOCTYPE");
}

TEST(Robot, VisualThatHidesTheCollisionShapesIsRefused) {
  expect_refused(
      "<robot name='r'><link name='a'><visual><geometry><capsule/></geometry></visual>"
      "<collision><geometry><sphere radius='1'/></geometry></collision></link></robot>",
      "[a]");
}

const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

double signed_volume(const Mesh& mesh) {
  double six = 0;
  for (const auto& t : mesh.triangles) {
    six += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  }
  return six / 6;
}

TEST(Robot, MeshesAreScaledAndReadOnce) {
  int reads = 0;
  const Robot robot = parse_urdf(R"(<robot name="r"><link name="a">
    <collision><geometry><mesh filename="package://p/m.OBJ"/></geometry></collision>
    <collision><geometry><mesh filename="package://p/m.OBJ"/></geometry></collision>
    <collision><geometry><mesh filename="package://p/m.OBJ" scale="0.5 2 -3"/></geometry></collision></link></robot>)",
                                 [&](const std::string& reference) {
                                   EXPECT_EQ(reference, "package://p/m.OBJ");
                                   ++reads;
                                   return tetrahedron;
                                 });
  const std::vector<Shape>& shapes = robot.links[0].shapes;
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].mesh, shapes[1].mesh);
  EXPECT_EQ(reads, 2) << "once per scale";
  EXPECT_NEAR(signed_volume(*shapes[0].mesh), 1.0 / 6, 1e-7);
  EXPECT_NEAR(signed_volume(*shapes[2].mesh), 3.0 / 6, 1e-7) << "mirrored, but still the right side out";
}

TEST(Robot, MeshThatCannotBeUsedIsRefused) {
  const auto urdf = [](const std::string& scale) {
    return with_shape("<mesh filename='m.obj' scale='" + scale + "'/>");
  };
  const auto give = [](const std::string& bytes) { return [bytes](const std::string&) { return bytes; }; };
  EXPECT_THROW(parse_urdf(urdf("1 0 1"), give(tetrahedron)), InputError);
  EXPECT_THROW(parse_urdf(urdf("1 1 1"), give("this is no mesh")), InputError);
  const auto sentence = [&](const std::string& xml) {
    try {
      parse_urdf(xml, give(tetrahedron));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(sentence(urdf("1 1 101")).find("scale=\"0.001 0.001 0.001\""), std::string::npos);
  EXPECT_NE(sentence(with_shape("<mesh filename='http://robots.example/m.obj'/>")).find("save it"), std::string::npos);
}

}  // namespace
}  // namespace sculpt
