// Which pairs the replay keeps apart, and that what it leaves out can be left out.
#include "core/verify/robot/checked_pairs.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/verify/home_contacts.hpp"
#include "core/verify/robot/bearing.hpp"
#include "core/verify/robot/joint_range.hpp"
#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

Shape cylinder_shape(const Vec3& centre, double radius_m, double length_m) {
  Shape shape;
  shape.kind = ShapeKind::cylinder;
  shape.pose.translation() = centre;
  shape.radius_m = radius_m;
  shape.length_m = length_m;
  return shape;
}

VoxelGrid no_material() {
  return {VoxelSet(8), VoxelSet(8)};
}

// A gantry whose ram of 40 mm goes through a hole of 160 mm in a plate, which is in its way nearly everywhere.
Cell plate_and_ram(double reach_m) {
  Cell cell = gantry_cell();
  auto& joints = cell.robot.joints;
  for (std::size_t axis : {0u, 1u}) {
    joints[axis].lower = -reach_m;
    joints[axis].upper = reach_m;
  }
  for (Link& link : cell.robot.links) link.shapes.clear();
  cell.robot.links.back().shapes.push_back(box_shape(Vec3(0, 0, -0.5), Vec3(0.04, 0.04, 1)));
  add_link(cell.robot, "plate", 0);
  for (double side : {-1, 1}) {
    cell.robot.links.back().shapes.push_back(box_shape(Vec3(0.04 + side * 1.58, 0.04, 0.6), Vec3(3, 6.16, 0.02)));
    cell.robot.links.back().shapes.push_back(box_shape(Vec3(0.04, 0.04 + side * 1.58, 0.6), Vec3(0.16, 3, 0.02)));
  }
  cell.rest = {0.04, 0.04, 0.15, 0};
  return cell;
}

Verdict go(const Cell& cell, const std::vector<Configuration>& stops) {
  GantryProgram program(cell, 8);
  for (const Configuration& stop : stops) program.keyframes.push_back({stop, false, {}, {}});
  program.go_home();
  return verify_text(program.text(), cell, no_material());
}

TEST(CheckedPairs, ARamThatGoesThroughAPlateIsFound) {
  for (double reach_m : {0.8, 2.0}) {
    const Cell cell = plate_and_ram(reach_m);
    const Verdict through = go(cell, {Eigen::Vector3d(0.5, 0.04, 0.15)});
    EXPECT_TRUE(found(through, {"spindle", "plate"})) << reach_m << "\n" << sentences(through);
    const Verdict inside = go(cell, {Eigen::Vector3d(0.09, -0.01, 0.1), Eigen::Vector3d(-0.01, 0.04, 0.3)});
    EXPECT_TRUE(inside.clean) << reach_m << "\n" << sentences(inside);
    EXPECT_TRUE(inside.exempt_pairs.empty());
  }
}

// A bar on a turning column; `horn` is a second shape of the column's head, `post` one beside the column's foot.
struct Turning {
  Cell cell;
  std::vector<int> joints{0};

  Turning() {
    add_link(cell.robot, "foot", -1);
    add_link(cell.robot, "head", 0, hinge("turn", Vec3(0, 0, 0.2)));
    cell.robot.links[0].shapes.push_back(cylinder_shape(Vec3(0, 0, 0.1), 0.05, 0.2));
    cell.robot.links[1].shapes.push_back(cylinder_shape(Vec3(0, 0, 0.05), 0.05, 0.1));
    cell.rest = {0};
    cell.stock_link = 0;
  }

  CheckedPairs pairs() const {
    const LinkMotion motion(cell.robot, joints, cell.rest, 0);
    const std::vector<SolidBody> bodies = make_solid_bodies(cell.robot);
    return choose_pairs(cell, joints, motion, bodies);
  }
};

TEST(CheckedPairs, OnlyTheTwoShapesOfABearingAreLetOff) {
  Turning turning;
  EXPECT_TRUE(turning.pairs().checked.empty());
  ASSERT_EQ(turning.pairs().exempt.size(), 1u);
  EXPECT_EQ(turning.pairs().exempt[0], (ExemptPair{"foot", "head", "neighbours that touch at their joint"}));
  turning.cell.robot.links[0].shapes.push_back(box_shape(Vec3(0.2, 0.2, 0.25), Vec3(0.05, 0.05, 0.5)));
  turning.cell.robot.links[1].shapes.push_back(box_shape(Vec3(0.2, 0, 0.08), Vec3(0.3, 0.02, 0.02)));
  EXPECT_EQ(turning.pairs().checked.size(), 3u) << "post and head, foot and horn, post and horn";
}

TEST(CheckedPairs, WhatTouchesAtHomeBesideTheBearingIsChecked) {
  Turning turning;
  turning.cell.robot.links[1].shapes.push_back(box_shape(Vec3(0.2, 0, 0.08), Vec3(0.3, 0.02, 0.02)));
  turning.cell.robot.links[0].shapes.push_back(box_shape(Vec3(0.3, 0, 0.25), Vec3(0.05, 0.05, 0.5)));
  const CheckedPairs pairs = turning.pairs();
  EXPECT_EQ(pairs.checked.size(), 3u);
  EXPECT_EQ(pairs.exempt.size(), 1u);
  ASSERT_EQ(pairs.contacts.size(), 1u);
  const std::string said = describe_home_contact(turning.cell.robot, pairs.contacts[0]);
  EXPECT_NE(said.find("link foot and link head touch at home"), std::string::npos) << said;
  EXPECT_EQ(find_home_contacts(turning.cell, {0}), pairs.contacts);
}

TEST(CheckedPairs, TheCellOverrulesTheRule) {
  Turning turning;
  turning.cell.check_pairs = {{0, 1}};
  EXPECT_EQ(turning.pairs().checked.size(), 1u);
  EXPECT_TRUE(turning.pairs().exempt.empty());
  turning.cell.check_pairs.clear();
  turning.cell.ignore_pairs = {{0, 1}};
  turning.cell.robot.links[0].shapes.push_back(box_shape(Vec3(0.2, 0.2, 0.25), Vec3(0.05, 0.05, 0.5)));
  EXPECT_TRUE(turning.pairs().checked.empty());
  EXPECT_EQ(turning.pairs().exempt[0].why, "the cell's ignore_pairs");
}

TEST(CheckedPairs, NeighboursThatRunIntoEachOtherAreFound) {
  Cell cell = gantry_cell();
  cell.robot.links[2].shapes.push_back(box_shape(Vec3(0, 0, 0.4), Vec3(0.03, 0.03, 0.02)));  // over the spindle
  const Verdict verdict = go(cell, {Eigen::Vector3d(0, 0, 0.25)});
  EXPECT_TRUE(found(verdict, {"carriage", "spindle"})) << sentences(verdict);
  const Verdict below = go(cell, {Eigen::Vector3d(0, 0, 0.22)});
  EXPECT_TRUE(below.clean) << sentences(below);
}

// Two shapes and one to three joints between them.
struct RandomPair {
  Cell cell;
  std::vector<int> joints;

  explicit RandomPair(Random& random) {
    const int count = 1 + static_cast<int>(random.next() % 3);
    add_link(cell.robot, "link0", -1);
    for (int at = 0; at < count; ++at) {
      Joint joint = hinge("", 0.03 * Vec3(random.unit(), random.unit(), random.unit()),
                          Vec3(random.between(-1, 1), random.between(-1, 1), random.between(0.1, 1)).normalized());
      joint.kind = random.unit() < 0.7 ? JointKind::revolute : JointKind::prismatic;
      joint.upper = joint.kind == JointKind::revolute ? random.between(0.1, 3) : random.between(0.01, 0.08);
      joint.lower = -joint.upper;
      joints.push_back(at);
      cell.rest.push_back(0);
      add_link(cell.robot, "link" + std::to_string(at + 1), at, joint);
    }
    for (Link* link : {&cell.robot.links.front(), &cell.robot.links.back()}) {
      Shape shape = random.unit() < 0.5 ? box_shape(Vec3::Zero(), Vec3(0.1, 0.08, 0.06) * random.between(0.3, 1.5))
                                        : cylinder_shape(Vec3::Zero(), 0.05 * random.between(0.3, 1.5), 0.12);
      shape.pose.translation() = 0.03 * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
      shape.pose.rotate(Eigen::AngleAxisd(random.between(0, 3), Vec3(1, random.unit(), random.unit()).normalized()));
      link->shapes.push_back(shape);
    }
  }
};

TEST(CheckedPairs, WhatIsProvedToOverlapOverlapsWhereverOneLooks) {
  int proved = 0, parted = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const RandomPair pair(random);
    const LinkMotion motion(pair.cell.robot, pair.joints, pair.cell.rest, 0);
    const std::vector<SolidBody> bodies = make_solid_bodies(pair.cell.robot);
    const JointRange range = joint_limits(pair.cell.robot, pair.joints);
    const bool always = overlap_everywhere(bodies[0], bodies[1], motion, range);
    proved += always;
    std::vector<Frame> poses;
    for (int look = 0; look < 300; ++look) {
      Configuration q = range.middle;
      for (Eigen::Index at = 0; at < q.size(); ++at)  // corners of the range too
        q[at] += range.half[at] * std::clamp(random.between(-1.3, 1.3), -1.0, 1.0);
      motion.place_links(q, poses);
      if (touch(bodies[0], bodies[1], poses)) continue;
      EXPECT_FALSE(always) << q.transpose();
      ++parted;
      break;
    }
  }
  EXPECT_GT(proved, 20);
  EXPECT_GT(parted, 20);
}

// Else no plan of such a cell could be clean.
TEST(CheckedPairs, CellsOfRealRobotsDoNotTouchAtHome) {
  namespace fs = std::filesystem;
  std::vector<fs::path> cells;
  for (const fs::path& folder : {fs::path(SOURCE_DIR "/config/cells"), fs::path(SOURCE_DIR "/../shared/data/cells")}) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
      if (entry.path().extension() == ".json") cells.push_back(entry.path());
  }
  ASSERT_GE(cells.size(), 3u);
  for (const fs::path& path : cells) {
    SCOPED_TRACE(path);
    const Cell cell = parse_cell(read_cell_files(path));
    const Chain chain = cell.chain();
    const std::vector<int> joints(chain.joints().begin(), chain.joints().end());
    const LinkMotion motion(cell.robot, joints, cell.rest, cell.stock_link);
    const std::vector<SolidBody> bodies = make_solid_bodies(cell.robot);
    EXPECT_EQ(choose_pairs(cell, joints, motion, bodies).contacts, std::vector<LinkPair>{});
  }
}

}  // namespace
}  // namespace sculpt
