#include "core/collision/shape/one_joint.hpp"

#include <gtest/gtest.h>

#include "tests/core/base/cases.hpp"
#include "tests/core/collision/random_bodies.hpp"

namespace sculpt {
namespace {

Frame pose_at(const OneJointMotion& motion, double way) {
  if (!motion.turns) return Eigen::Translation3d(way * motion.axis) * motion.pose;
  return Eigen::Translation3d(motion.point) * Eigen::AngleAxisd(way, motion.axis) *
         Eigen::Translation3d(-motion.point) * motion.pose;
}

OneJointMotion random_motion(Random& random) {
  const bool turns = random.unit() < 0.7;
  return {random_pose(random, 0.4), turns, random_direction(random), random_vector(random, 0.1),
          turns ? random.between(-6.5, 6.5) : random.between(-0.5, 0.5)};
}

/// A tube about z of so many flat walls, open at both ends.
std::shared_ptr<Mesh> tube(double radius_m, double length_m, std::uint32_t walls) {
  auto mesh = std::make_shared<Mesh>();
  for (std::uint32_t wall = 0; wall < walls; ++wall) {
    const double angle = 2 * std::numbers::pi * wall / walls;
    for (const double z : {0.0, length_m})
      mesh->vertices.push_back({radius_m * std::cos(angle), radius_m * std::sin(angle), z});
    const std::uint32_t low = 2 * wall, next = 2 * ((wall + 1) % walls);
    mesh->triangles.push_back({low, next, low + 1});
    mesh->triangles.push_back({next, next + 1, low + 1});
  }
  return mesh;
}

Body mesh_body(std::shared_ptr<const Mesh> mesh) {
  Shape shape;
  shape.kind = ShapeKind::mesh;
  shape.mesh = std::move(mesh);
  return body_of(shape);
}

TEST(OneJoint, BodiesThatStayApartDoSoAsFclMeasuresIt) {
  int apart = 0, refused = 0, close = 0;
  for (int seed = 0; seed < cases(300); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(static_cast<std::uint64_t>(seed));
    const Shape first = random_shape(random), second = random_shape(random);
    const OneJointMotion motion = random_motion(random);
    const double margin = random.between(1e-4, 0.02);
    const bool stays = stay_apart(body_of(first), body_of(second), motion, margin);
    const FclPair pair(first, second);
    double least = 1;
    for (int place = 0; place <= 200; ++place)
      least = std::min(least, pair.distance_m(pose_at(motion, motion.way * place / 200), Frame::Identity()));
    stays ? ++apart : ++refused;
    close += stays && least < 0.05;
    if (stays) {
      EXPECT_GT(least, margin - 1e-4);
    } else {
      EXPECT_LT(least, 1.02 * margin + 0.004) << "refused, though there is room";
    }
  }
  EXPECT_GT(apart, cases(60));
  EXPECT_GT(refused, cases(60));
  EXPECT_GT(close, cases(10));
}

TEST(OneJoint, AShaftTurnsInATubeAroundIt) {
  const Body shaft = mesh_body(tube(0.0494, 0.1, 90)), around = mesh_body(tube(0.05, 0.1, 90));
  const OneJointMotion motion{Frame::Identity(), true, Vec3::UnitZ(), Vec3::Zero(), 6};
  EXPECT_TRUE(stay_apart(shaft, around, motion, 0.0002));
  EXPECT_TRUE(stay_apart(around, shaft, motion, 0.0002));
  EXPECT_FALSE(stay_apart(shaft, around, motion, 0.0007));
  OneJointMotion beside = motion;
  beside.point.x() = 0.001;
  EXPECT_FALSE(stay_apart(shaft, around, beside, 0.0002)) << "about an axis that is not its own";
}

TEST(OneJoint, AContactThatLastsForAMomentIsSeen) {
  Shape bump, finger;
  bump.kind = finger.kind = ShapeKind::sphere;
  bump.radius_m = finger.radius_m = 0.001;
  bump.pose.translation() = Vec3(0.3, 0, 0);
  finger.pose.translation() = Vec3(0.3018, 0, 0);
  for (int seed = 0; seed < 50; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const Frame start(Eigen::AngleAxisd(random.between(-3, -0.1), Vec3::UnitZ()));
    const OneJointMotion motion{start, true, Vec3::UnitZ(), Vec3::Zero(), random.between(3.1, 6)};
    EXPECT_FALSE(stay_apart(body_of(finger), body_of(bump), motion, 1e-4));
    bump.pose.translation().z() = 0.0025;
    EXPECT_TRUE(stay_apart(body_of(finger), body_of(bump), motion, 1e-4));
    bump.pose.translation().z() = 0;
  }
}

}  // namespace
}  // namespace sculpt
