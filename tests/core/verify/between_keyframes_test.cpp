// Motions whose two ends are free and which touch something on the way.
#include <gtest/gtest.h>

#include "core/mesh/mesh.hpp"
#include "core/trajectory/header.hpp"
#include "core/trajectory/writer.hpp"
#include "core/verify/findings/findings.hpp"
#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

VoxelGrid no_material(int n) {
  return {VoxelSet(n), VoxelSet(n)};
}

TEST(BetweenKeyframes, ASpindleThroughAThinFixtureIsFound) {
  for (double thickness_m : {0.05, 0.001, 0.0001}) {
    Cell cell = gantry_cell();
    add_link(cell.robot, "fixture", 0);
    cell.robot.links.back().shapes.push_back(box_shape(Vec3(0.12, 0.04, 0.3), Vec3(thickness_m, 0.2, 0.2)));
    cell.rest.push_back(0);
    GantryProgram program(cell, 8);
    program.keyframes.push_back({Eigen::Vector3d(0.05, 0.04, 0.15), false, {}, {}});
    program.keyframes.push_back({Eigen::Vector3d(0.19, 0.04, 0.15), false, {}, {}});
    program.keyframes.push_back({Eigen::Vector3d(0.19, 0.04, 0.15), false, {}, {}});
    const Verdict verdict = verify_text(program.text(), cell, no_material(8));
    EXPECT_TRUE(found(verdict, {"spindle", "fixture"})) << thickness_m << "\n" << sentences(verdict);
  }
}

TEST(BetweenKeyframes, AToolThroughAOneVoxelWallIsFound) {
  const Cell cell = gantry_cell();
  VoxelGrid voxels = no_material(8);
  for (int j = 0; j < 8; ++j)
    for (int k = 0; k < 8; ++k) voxels.stock.insert({4, j, k});
  GantryProgram program(cell, 8);
  program.move(Vec3(-0.5, 4, 4));
  program.move(Vec3(9, 4, 4));
  program.move(Vec3(9, 4, 9));
  program.go_home();
  const Verdict verdict = verify_text(program.text(), cell, voxels);
  EXPECT_TRUE(found(verdict, {"ball", "material"})) << sentences(verdict);
  EXPECT_TRUE(found(verdict, {"shank", "material"})) << sentences(verdict);
}

TEST(BetweenKeyframes, LinksOfTheRobotThatMeetAreFound) {
  const Cell cell = gantry_cell();
  GantryProgram program(cell, 8);
  program.keyframes.push_back({Eigen::Vector3d(0, 0.1, 0.15), false, {}, {}});
  program.keyframes.push_back({Eigen::Vector3d(0, 0.4, 0.15), false, {}, {}});  // past the bridge's column
  program.keyframes.push_back({Eigen::Vector3d(0, 0.4, 0.3), false, {}, {}});
  program.keyframes.push_back({Eigen::Vector3d(0, 0.1, 0.3), false, {}, {}});
  program.go_home();
  const Verdict verdict = verify_text(program.text(), cell, no_material(8));
  EXPECT_TRUE(found(verdict, {"bridge", "spindle"})) << sentences(verdict);
  EXPECT_TRUE(found(verdict, {"shank", "bridge"})) << sentences(verdict);
  for (const Finding& finding : verdict.findings) EXPECT_EQ(finding.line % 2, 1u) << sentences(verdict);
}

// An arm of three hinges over a table: upper and lower arm are bars of 0.3 m, the tool points down.
Cell hinged_cell() {
  Cell cell;
  cell.name = "hinged";
  const int table = add_link(cell.robot, "table", -1);
  cell.robot.links[0].shapes.push_back(box_shape(Vec3(0, 0, -0.05), Vec3(2, 2, 0.1)));
  const int upper = add_link(cell.robot, "upper_arm", table, hinge("shoulder", Vec3(0, 0, 0.3)));
  cell.robot.links.back().shapes.push_back(box_shape(Vec3(0.14, 0, 0), Vec3(0.28, 0.01, 0.03)));
  const int lower = add_link(cell.robot, "lower_arm", upper, hinge("elbow", Vec3(0.3, 0, 0)));
  cell.robot.links.back().shapes.push_back(box_shape(Vec3(0.145, 0, 0), Vec3(0.25, 0.01, 0.03)));
  Joint wrist = hinge("wrist", Vec3(0.3, 0, 0));
  wrist.origin.linear() = Eigen::AngleAxisd(EIGEN_PI, Vec3::UnitX()).toRotationMatrix();
  cell.tool_link = add_link(cell.robot, "spindle", lower, wrist);
  Shape motor;
  motor.kind = ShapeKind::cylinder;
  motor.radius_m = 0.02;
  motor.length_m = 0.04;
  cell.robot.links.back().shapes.push_back(motor);
  cell.stock_link = table;
  cell.stock_size_m = 0.08;
  cell.stock_origin_m = Vec3(0.4, -0.04, 0.0);
  cell.tool.stickout_m = 0.15;
  cell.rest = {-1, 0.3, 0};
  return cell;
}

Verdict swing(const Cell& cell, const VoxelGrid& voxels, const std::vector<Eigen::Vector3d>& stops) {
  TrajectoryHeader header;
  header.joints = {"shoulder", "elbow", "wrist"};
  header.home = Eigen::Vector3d(cell.rest[0], cell.rest[1], cell.rest[2]);
  header.grid = cell.grid(voxels.n());
  header.tool = make_tool(cell.tool, header.grid.voxel_m);
  header.tolerance_m = 0.02 * header.grid.voxel_m;
  std::ostringstream out;
  TrajectoryWriter writer(out, header);
  for (const Eigen::Vector3d& stop : stops) writer.add({stop, false, {}, {}});
  writer.add({header.home, false, {}, {}});
  writer.finish();
  return verify_text(out.str(), cell, voxels);
}

TEST(BetweenKeyframes, AnArmThatSweepsThroughAThinPostIsFound) {
  Cell cell = hinged_cell();
  add_link(cell.robot, "post", 0);
  cell.robot.links.back().shapes.push_back(box_shape(Vec3(0.4, 0, 0.3), Vec3(0.001, 0.001, 0.5)));
  cell.rest.push_back(0);
  const Verdict hit = swing(cell, no_material(8), {{0.5, 0.3, 0}});
  EXPECT_TRUE(found(hit, {"lower_arm", "post"})) << sentences(hit);
  const Verdict past =
      swing(cell, no_material(8), {{-1, 2.5, 0}, {0.5, 2.5, 0}, {1.2, 0.3, 0}, {0.5, 2.5, 0}, {-1, 2.5, 0}});
  EXPECT_TRUE(past.clean) << sentences(past);
}

TEST(BetweenKeyframes, AToolThatSweepsThroughOneVoxelIsFound) {
  const Cell cell = hinged_cell();
  VoxelGrid voxels = no_material(8);
  // The ball's circle of radius 0.44 (elbow bent) passes the voxels around (0.44, 0, 0.15): above the grid; the shank
  // does not.
  const Verdict above = swing(cell, voxels, {{0.4, 1.5, 0}});
  EXPECT_TRUE(above.clean) << sentences(above);
  Cell low = cell;
  low.tool.stickout_m = 0.25;  // ball at z = 0.05, in the grid
  voxels.stock.insert({3, 4, 5});
  EXPECT_TRUE(swing(low, no_material(8), {{0.4, 1.5, 0}}).clean);
  const double reach = low.grid(8).centre({3, 4, 5}).head<2>().norm();
  const double elbow = 2 * std::acos(reach / 0.6);  // isosceles triangle of two arms
  const Verdict hit = swing(low, voxels, {{-2, elbow, 0}, {1, elbow, 0}});
  EXPECT_TRUE(found(hit, {"shank", "material"})) << sentences(hit);
  const double past = 2 * std::acos((reach + 0.011) / 0.6);
  const Verdict beside = swing(low, voxels, {{-2, past, 0}, {1, past, 0}, {-2, past, 0}});
  EXPECT_TRUE(beside.clean) << sentences(beside);
}

// Every swing of an arm is curved: the replay must find what a plain dense sampling finds, and nothing where that stays
// well clear.
TEST(BetweenKeyframes, RandomSwingsAreFoundExactlyWhenTheyHit) {
  Cell cell = hinged_cell();
  cell.tool.stickout_m = 0.25;
  const double voxel_m = cell.grid(8).voxel_m;
  int hits = 0, misses = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    VoxelGrid voxels = no_material(8);
    for (int count = 0; count < 6; ++count) {
      const auto index = [&] { return static_cast<int>(random.next() % 8); };
      voxels.stock.insert({index(), index(), index()});
    }
    const Eigen::Vector3d home(-1, 0.3, 0);
    // Somewhere over the block; two equal bars and the way to the ball are an isosceles triangle.
    const Eigen::Vector2d goal(random.between(0.4, 0.48), random.between(-0.04, 0.04));
    const double elbow = 2 * std::acos(goal.norm() / 0.6);
    const Eigen::Vector3d stop(std::atan2(goal.y(), goal.x()) - elbow / 2, elbow, random.between(-1, 1));
    double least = 1;  // voxel edges; samples are at most 0.05 apart
    for (int s = 0; s <= 6000; ++s) {
      const Eigen::Vector3d q = home + (stop - home) * s / 6000;
      const Vec3 ball(0.3 * std::cos(q[0]) + 0.3 * std::cos(q[0] + q[1]),
                      0.3 * std::sin(q[0]) + 0.3 * std::sin(q[0] + q[1]), 0.05);
      const Vec3 at = (ball - cell.stock_origin_m) / voxel_m;
      least = std::min(least, min_upright_gap(at, voxels.stock));
    }
    const Verdict verdict = swing(cell, voxels, {stop});
    if (least < -0.001) {
      ++hits;
      EXPECT_FALSE(verdict.clean) << least;
    }
    if (least > 0.03) {
      ++misses;
      EXPECT_TRUE(verdict.clean) << least << "\n" << sentences(verdict);
    }
  }
  EXPECT_GT(hits, 20);
  EXPECT_GT(misses, 20);
}

TEST(BetweenKeyframes, AFoldedArmThatMeetsItselfIsFound) {
  Cell cell = hinged_cell();
  // The spindle turns about the elbow into the upper arm's root.
  const Verdict verdict = swing(cell, no_material(8), {{-1, 2.0, 0}, {-1, 2.6, 0}});
  EXPECT_TRUE(verdict.clean) << sentences(verdict);
  const Verdict neighbours = swing(cell, no_material(8), {{-1, 3.0, 0}});
  EXPECT_TRUE(found(neighbours, {"upper_arm", "lower_arm"})) << sentences(neighbours);
  for (Joint& joint : cell.robot.joints) joint.upper = 3.2;
  const Verdict folded = swing(cell, no_material(8), {{-1, 3.141, 0}});
  EXPECT_TRUE(found(folded, {"upper_arm", "spindle"})) << sentences(folded);
}

TEST(BetweenKeyframes, MeshesAreReplayedToo) {
  Cell cell = gantry_cell();
  // A pyramid in place of the spindle's box, and one that stands in the room.
  auto pyramid = std::make_shared<Mesh>();
  pyramid->vertices = {{-0.02, -0.02, 0}, {0.02, -0.02, 0}, {0.02, 0.02, 0}, {-0.02, 0.02, 0}, {0, 0, -0.04}};
  pyramid->triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 2, 1}, {0, 3, 2}};
  Shape shape;
  shape.kind = ShapeKind::mesh;
  shape.mesh = pyramid;
  cell.robot.links[static_cast<std::size_t>(cell.tool_link)].shapes = {shape};
  add_link(cell.robot, "cone", 0);
  shape.pose.translation() = Vec3(0.12, 0.04, 0.28);
  cell.robot.links.back().shapes = {shape};
  cell.rest.push_back(0);
  GantryProgram program(cell, 8);
  program.keyframes.push_back({Eigen::Vector3d(0.05, 0.04, 0.15), false, {}, {}});
  program.keyframes.push_back({Eigen::Vector3d(0.19, 0.04, 0.15), false, {}, {}});
  const Verdict hit = verify_text(program.text(), cell, no_material(8));
  EXPECT_TRUE(found(hit, {"spindle", "cone"})) << sentences(hit);
  // Past it at 1 mm: boxes would touch, the slanted faces do not.
  GantryProgram past(cell, 8);
  for (double x : {0.05, 0.19, 0.05}) past.keyframes.push_back({Eigen::Vector3d(x, 0.04 + 0.041, 0.15), false, {}, {}});
  past.go_home();
  const Verdict clean = verify_text(past.text(), cell, no_material(8));
  EXPECT_TRUE(clean.clean) << sentences(clean);
}

}  // namespace
}  // namespace sculpt
