#include "core/doctor/make/urdf_text.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/core/cell/sample_robots.hpp"
#include "tests/core/doctor/doctor_cells.hpp"

namespace sculpt {
namespace {

TEST(UrdfText, LinksAndJointsAreFoundWithWhatTheyJoin) {
  const auto elements = urdf_elements(makers_arm);
  const Robot robot = parse_plain(makers_arm);
  std::size_t links = 0, joints = 0;
  for (const UrdfElement& element : elements) {
    if (element.tag == "link") {
      ++links;
      EXPECT_GE(robot.find_link(element.name), 0) << element.name;
      continue;
    }
    ++joints;
    const int joint = robot.find_joint(element.name);
    ASSERT_GE(joint, 0) << element.name;
    EXPECT_EQ(robot.find_link(element.parent), robot.joints[static_cast<std::size_t>(joint)].parent_link);
    EXPECT_EQ(robot.find_link(element.child), robot.joints[static_cast<std::size_t>(joint)].child_link);
  }
  EXPECT_EQ(links, robot.links.size()) << "the one in the comment is none";
  EXPECT_EQ(joints, robot.joints.size());
}

TEST(UrdfText, ABranchGoesWithAllThatHangsOnIt) {
  const Robot robot = parse_plain(without_branch(makers_arm, "hand"));
  for (const char* link : {"hand", "left", "right"}) EXPECT_EQ(robot.find_link(link), -1) << link;
  EXPECT_GE(robot.find_link("flange"), 0);
  EXPECT_EQ(robot.find_joint("jh"), -1);
  EXPECT_THROW(without_branch(makers_arm, "ghost"), InputError) << "it stands in a comment";
}

TEST(UrdfText, ElementsAreAddedAtTheEnd) {
  const std::string more =
      R"(<link name="more"/><joint name="m" type="fixed"><parent link="flange"/><child link="more"/></joint>)";
  EXPECT_GE(parse_plain(with_elements(makers_arm, more)).find_link("more"), 0);
  EXPECT_THROW(with_elements("<robot name='x'><link name='a'/>", more), InputError);
}

TEST(UrdfText, AReferenceIsChangedInWholeAttributesOnly) {
  EXPECT_EQ(with_reference("<mesh filename=\"a.stl\"/><mesh filename='a.stl'/><mesh filename=\"ba.stl\"/>", "a.stl",
                           "m/a.stl"),
            "<mesh filename=\"m/a.stl\"/><mesh filename='m/a.stl'/><mesh filename=\"ba.stl\"/>");
}

}  // namespace
}  // namespace sculpt
