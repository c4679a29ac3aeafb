#include "core/collision/scene.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/collision/shape/body.hpp"
#include "core/collision/shape/motion_bound.hpp"
#include "tests/core/base/cases.hpp"
#include "tests/core/collision/small_arm.hpp"

namespace sculpt {
namespace {

Configuration random_near(const Chain& chain, Random& random, const Configuration& around, double by) {
  Configuration q(chain.dof());
  for (int i = 0; i < chain.dof(); ++i)
    q[i] = std::clamp(around[i] + random.between(-by, by), chain.lower()[i], chain.upper()[i]);
  return q;
}

Configuration random_within(const Chain& chain, Random& random) {
  return random_near(chain, random, (chain.lower() + chain.upper()) / 2, 10);
}

TEST(Scene, NoSampleOfACertifiedEdgeTouchesAnything) {
  const Cell cell = make_test_cell();
  int certified = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    VoxelSet standing(16, true);
    for (int r = 0; r < 2500; ++r)
      standing.erase({static_cast<int>(random.next() % 16), static_cast<int>(random.next() % 16),
                      static_cast<int>(random.next() % 16)});
    const Scene scene(cell, cell.grid(16), standing);
    const Configuration from = random_within(scene.chain(), random);
    if (scene.contact_at(from) != Contact::none) continue;
    const Configuration to = random_near(scene.chain(), random, from, random.between(0.01, 0.8));
    if (scene.certify(from, to) != Contact::none) {
      ++refused;
      continue;
    }
    ++certified;
    for (int s = 0; s <= 300; ++s)
      ASSERT_EQ(scene.contact_at(from + (to - from) * (s / 300.0)), Contact::none) << "sample " << s;
  }
  EXPECT_GT(certified, 20);
  EXPECT_GT(refused, 20);
}

TEST(Scene, AnEdgeWhoseMiddleTouchesIsNeverCertified) {
  const Cell cell = make_test_cell();
  const Scene scene(cell, cell.grid(16), VoxelSet(16, true));
  int tried = 0;
  for (std::uint64_t seed = 0; seed < cases(4000u) && tried < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Configuration from = random_within(scene.chain(), random);
    const Configuration to = random_near(scene.chain(), random, from, 1.5);
    if (scene.contact_at(from) != Contact::none || scene.contact_at(to) != Contact::none) continue;
    bool touches = false;
    for (int s = 1; s < 60; ++s)
      touches = touches || scene.contact_at(from + (to - from) * (s / 60.0)) != Contact::none;
    if (!touches) continue;
    ++tried;
    EXPECT_NE(scene.certify(from, to), Contact::none) << "both ends are free, the way between is not";
  }
  EXPECT_GE(tried, cases(50));
}

TEST(Scene, TheExemptVoxelExemptsOnlyItself) {
  const Cell cell = make_test_cell();
  const Grid grid = cell.grid(8);
  VoxelSet standing(8);
  const Voxel target{4, 4, 4}, neighbour{4, 4, 5};
  standing.insert(target);
  Scene scene(cell, grid, standing);
  const ToolPose pose{grid.centre(target), Vec3::UnitZ()};
  EXPECT_FALSE(scene.tool_fits(pose, {}));
  EXPECT_TRUE(scene.tool_fits(pose, target));
  standing.insert(neighbour);
  const Scene blocked(cell, grid, standing);
  EXPECT_FALSE(blocked.tool_fits(pose, target)) << "the shank passes through the voxel above";
}

TEST(Scene, OutsideTheLimitsIsAContact) {
  const Cell cell = make_test_cell();
  const Scene scene(cell, cell.grid(8), VoxelSet(8));
  Configuration q = cell.home(scene.chain());
  ASSERT_EQ(scene.contact_at(q), Contact::none);
  q[0] = 3.2;
  EXPECT_EQ(scene.contact_at(q), Contact::limits);
  EXPECT_EQ(scene.certify(cell.home(scene.chain()), q), Contact::limits);
}

TEST(MotionBound, HoldsForRandomMotionsOfEveryLinkSeenFromEveryOther) {
  const Cell cell = make_test_cell();
  const Chain chain = cell.chain();
  const int links = static_cast<int>(cell.robot.links.size());
  std::vector<Frame> before, after;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Configuration q = random_within(chain, random);
    const Configuration step = (random_near(chain, random, q, 1e-4) - q);
    chain.link_poses(q, before);
    chain.link_poses(q + step, after);
    const double extent = random.between(0, 0.3);
    const Vec3 point = extent * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)).normalized();
    for (int fixed = 0; fixed < links; ++fixed)
      for (int moving = 0; moving < links; ++moving) {
        const auto seen = [&](const std::vector<Frame>& at) {
          return Vec3(at[static_cast<std::size_t>(fixed)].inverse() * (at[static_cast<std::size_t>(moving)] * point));
        };
        const double moved = (seen(after) - seen(before)).norm();
        EXPECT_LE(moved, motion_bound(chain, fixed, moving, extent).dot(step.cwiseAbs()) + 1e-12)
            << fixed << " " << moving;
      }
  }
}

TEST(Body, EveryShapeLiesInTheHullAndTheExtent) {
  const Cell cell = make_test_cell();
  for (const Body& body : make_bodies(cell, make_tool(cell.tool, 0.01)))
    for (const Body::Part& part : body.parts) {
      const Convex::Corners corners = part.tree->root().shape.corners();
      for (std::size_t at = 0; at < corners.count; ++at) {
        const Vec3& point = corners.points[at];
        EXPECT_LE(distance(body.hull.core, {point, point}) + corners.radius, body.hull.radius_m + 1e-12);
      }
      for (const ShapeTree::Node& node : part.tree->nodes)
        if (node.is_leaf()) {
          EXPECT_LE(node.shape.middle.norm(), body.extent_m);
        }
    }
}

}  // namespace
}  // namespace sculpt
