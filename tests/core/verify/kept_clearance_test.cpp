// A kept clearance must never outlive what it says, and the bits must never hide what FCL sees.
#include "core/verify/kept_clearance.hpp"

#include <gtest/gtest.h>

#include "core/verify/material/standing_voxels.hpp"
#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

Cell chain_of_five(Random& random) {
  Cell cell;
  add_link(cell.robot, "link0", -1);
  for (int link = 1; link < 6; ++link) {
    const auto number = [&] { return random.between(-0.3, 0.3); };
    Joint joint = hinge("joint" + std::to_string(link), Vec3(number(), number(), number()),
                        Vec3(number(), number(), 0.4).normalized());
    if (link == 3) joint.kind = JointKind::prismatic;
    add_link(cell.robot, "link" + std::to_string(link), link == 5 ? 1 : link - 1, joint);
    cell.rest.push_back(0);
  }
  return cell;
}

TEST(KeptClearance, PointsComeNoNearerThanItSaysAnywhereOnTheMotion) {
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Cell cell = chain_of_five(random);
    const LinkMotion motion(cell.robot, {0, 1, 2, 3, 4}, cell.rest, 2);
    const Around first{4, 100 * Vec3(random.between(-1, 1), 1, 0), 30}, second{5, Vec3(50, 0, 20), 40};
    KeptClearance kept(motion, first, second);
    Configuration anchor(5), from(5), step(5);
    for (Eigen::Index at = 0; at < 5; ++at) {
      anchor[at] = random.between(-2, 2);
      from[at] = anchor[at] + random.between(-0.2, 0.2);
      step[at] = random.between(-0.2, 0.2);
    }
    std::vector<Frame> poses;
    motion.place_links(anchor, poses);
    kept.move_anchor(anchor, poses);
    EXPECT_FALSE(kept.covers({from, step}));
    // Some point of each: the distance between two of them.
    const Vec3 a = first.centre + 30 * Vec3(random.between(-1, 1), random.between(-1, 1), 0.1).normalized();
    const Vec3 b = second.centre + 40 * Vec3(random.between(-1, 1), 0.1, random.between(-1, 1)).normalized();
    const auto distance = [&] { return (poses[4] * a - poses[5] * b).norm(); };
    const double at_anchor = distance(), approach = kept.approach({from, step});
    for (int sample = 0; sample <= 50; ++sample) {
      motion.place_links(from + step * sample / 50, poses);
      EXPECT_GE(distance(), at_anchor - approach - 1e-9);
    }
    kept.prove(at_anchor);
    EXPECT_EQ(kept.covers({from, step}), approach <= at_anchor);
    covered += kept.covers({from, step});
    kept.forget();
    EXPECT_FALSE(kept.covers({from, step}));
  }
  EXPECT_GT(covered, 10);
  EXPECT_LT(covered, 290);
}

// FCL alone, on a box for every voxel.
bool touches_one_by_one(const VoxelSet& voxels, double voxel_mm, const fcl::CollisionGeometryd& part,
                        const Frame& pose) {
  for (int k = 0; k < voxels.n(); ++k)
    for (int j = 0; j < voxels.n(); ++j)
      for (int i = 0; i < voxels.n(); ++i) {
        if (!voxels.contains({i, j, k})) continue;
        const fcl::Boxd box(voxel_mm, voxel_mm, voxel_mm);
        const Frame at(Eigen::Translation3d(voxel_mm * Vec3(i + 0.5, j + 0.5, k + 0.5)));
        fcl::CollisionRequestd request(1, false);
        request.gjk_solver_type = fcl::GST_LIBCCD;
        fcl::CollisionResultd result;
        if (fcl::collide(&box, at, &part, pose, request, result) > 0) return true;
      }
  return false;
}

TEST(StandingVoxels, AgreeWithFclOnEveryVoxelByItselfWhileTheyAreCutAndPutBack) {
  constexpr double voxel_mm = 2.5;
  int touching = 0, asked = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int side = seed % 2 == 0 ? 4 : 8;
    const auto voxel = [&] {
      const auto number = [&] { return static_cast<int>(random.next() % static_cast<std::uint64_t>(side)); };
      return Voxel{number(), number(), number()};
    };
    VoxelSet stock(side, seed % 3 != 0);
    for (int at = 0; seed % 3 == 0 && at < 60; ++at) stock.insert(voxel());
    StandingVoxels standing(stock, voxel_mm);
    for (int round = 0; round < 60; ++round) {
      for (int removal = 0; removal < 8; ++removal) standing.remove(voxel());
      if (round % 3 == 0) {
        const Voxel back = voxel();
        standing.put_back(back);
        EXPECT_TRUE(standing.contains(back));
      }
      const double radius = random.between(0.2, 3);
      const fcl::Sphered ball(radius);
      const Vec3 at =
          side * voxel_mm * Vec3(random.between(-0.3, 1.3), random.between(-0.3, 1.3), random.between(0, 1));
      const Frame pose(Eigen::Translation3d{at});
      const Vec3 half = Vec3::Constant(radius);
      const bool touches = standing.touches(ball, pose, at - half, at + half);
      EXPECT_EQ(touches, touches_one_by_one(standing.voxels(), voxel_mm, ball, pose));
      touching += touches;
      ++asked;
    }
    for (int index = 0; index < side * side * side; ++index)
      standing.remove({index % side, index / side % side, index / side / side});
    const Vec3 middle = Vec3::Constant(side * voxel_mm / 2);
    EXPECT_FALSE(standing.touches(fcl::Sphered(99), Frame(Eigen::Translation3d{middle}), middle.array() - 99.0,
                                  middle.array() + 99.0));
  }
  EXPECT_GT(touching, asked / 10);
  EXPECT_LT(touching, asked * 9 / 10);
}

}  // namespace
}  // namespace sculpt
