// Closed forms against FCL, cube by cube.
#include "core/verify/material/convex_probe.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/verify/robot/solid_body.hpp"

namespace sculpt {
namespace {

Frame random_pose(Random& random) {
  const auto number = [&] { return random.between(-1, 1); };
  Frame pose = Frame::Identity();
  pose.translation() = 6 * Vec3(number(), number(), number());
  pose.linear() = Eigen::Quaterniond(number(), number(), number(), number()).normalized().toRotationMatrix();
  return pose;
}

/// By FCL, with the shape a little smaller and a little larger: in between it may say either.
template <typename Make>
void expect_as_fcl(const Make& make, std::uint64_t seed) {
  Random random(seed);
  int apart = 0, meet = 0;
  for (int round = 0; round < 4000; ++round) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round));
    const Frame pose = random_pose(random);
    const double half = random.between(0.2, 3);
    const Vec3 centre = 4 * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    const Vec3 size(random.between(0.3, 3), random.between(0.3, 3), random.between(0.3, 8));
    const fcl::Boxd cube(Vec3::Constant(2 * half));
    const Frame at{Eigen::Translation3d(centre)};
    const auto shape = make(size);
    const Meeting meeting = ConvexProbe::of(shape, pose)->with_cube(centre, half);
    const Vec3 little = Vec3::Constant(1e-4);
    if (meeting == Meeting::apart) {
      EXPECT_FALSE(solids_touch(make(size - little), pose, cube, at));
    }
    if (meeting == Meeting::meet) {
      EXPECT_TRUE(solids_touch(make(size + little), pose, cube, at));
    }
    apart += meeting == Meeting::apart;
    meet += meeting == Meeting::meet;
  }
  EXPECT_GT(apart, 400);
  EXPECT_GT(meet, 400);
  EXPECT_GT(apart + meet, 3800) << "little is left open";
}

TEST(ConvexProbe, OfASphereSaysWhatFclSays) {
  expect_as_fcl([](const Vec3& size) { return fcl::Sphered(size.z() / 2); }, 1);
}
TEST(ConvexProbe, OfACapsuleSaysWhatFclSays) {
  expect_as_fcl([](const Vec3& size) { return fcl::Capsuled(size.x(), size.z()); }, 2);
}
TEST(ConvexProbe, OfACylinderSaysWhatFclSays) {
  expect_as_fcl([](const Vec3& size) { return fcl::Cylinderd(size.x() / 2, size.z()); }, 3);
}
TEST(ConvexProbe, OfABoxSaysWhatFclSays) {
  expect_as_fcl([](const Vec3& size) { return fcl::Boxd(size); }, 4);
}
TEST(ConvexProbe, IsNotMadeOfAMesh) {
  EXPECT_FALSE(ConvexProbe::of(SolidMesh(), Frame::Identity()));
}

// By the distance of points of the segment from the cube, which needs no other code.
TEST(ConvexProbe, OfACapsuleSaysWhatItsPointsSay) {
  Random random(7);
  for (int round = 0; round < 2000; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    Frame pose = random_pose(random);
    if (round % 4 == 0) pose.linear() = Eigen::Matrix3d::Identity();  // along a face
    const double half = random.between(0.2, 3), length = random.between(0, 9), radius = random.between(0.2, 3);
    double least = 1e9;
    for (int sample = 0; sample <= 1000; ++sample) {
      const Vec3 at = pose * Vec3(0, 0, length * (sample / 1000.0 - 0.5));
      least = std::min(least, (at.cwiseAbs().array() - half).max(0.0).matrix().norm());
    }
    const Meeting meeting = ConvexProbe::of(fcl::Capsuled(radius, length), pose)->with_cube(Vec3::Zero(), half);
    if (least > radius + 0.01) {
      EXPECT_EQ(meeting, Meeting::apart) << least << " " << radius;
    }
    if (least < radius) {
      EXPECT_EQ(meeting, Meeting::meet) << least << " " << radius;
    }
  }
}

}  // namespace
}  // namespace sculpt
