// What touches the material: bricks of bits and closed forms against FCL alone, voxel by voxel.
#include "core/verify/material/standing_voxels.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/base/random.hpp"
#include "core/verify/robot/solid_body.hpp"

namespace sculpt {
namespace {

constexpr double voxel_mm = 2.5;

/// FCL alone, on a box for every voxel.
bool touches_one_by_one(const VoxelSet& voxels, const fcl::CollisionGeometryd& part, const Frame& pose) {
  bool touching = false;
  for_each_voxel(voxels, [&](Voxel v) {
    if (touching) return;
    const fcl::Boxd box(voxel_mm, voxel_mm, voxel_mm);
    const Frame at(Eigen::Translation3d(voxel_mm * Vec3(v.i + 0.5, v.j + 0.5, v.k + 0.5)));
    touching = solids_touch(box, at, part, pose);
  });
  return touching;
}

std::shared_ptr<fcl::CollisionGeometryd> random_shape(Random& random, std::uint64_t kind) {
  const auto size = [&] { return random.between(0.2, 9); };
  switch (kind) {
    case 0:
      return std::make_shared<fcl::Sphered>(random.between(0.2, 4));
    case 1:
      return std::make_shared<fcl::Capsuled>(random.between(0.2, 3), size());
    case 2:
      return std::make_shared<fcl::Cylinderd>(random.between(0.2, 3), size());
    case 3:
      return std::make_shared<fcl::Boxd>(size(), size(), size());
    default: {
      auto mesh = std::make_shared<SolidMesh>();
      const auto corner = [&] { return Vec3(random.between(-6, 6), random.between(-6, 6), random.between(-6, 6)); };
      mesh->beginModel(2);
      for (int triangle = 0; triangle < 2; ++triangle) mesh->addTriangle(corner(), corner(), corner());
      mesh->endModel();
      return mesh;
    }
  }
}

Frame random_pose(Random& random, double side_mm) {
  const auto number = [&] { return random.between(-1, 1); };
  Frame pose = Frame::Identity();
  pose.translation() = side_mm * Vec3(random.between(-0.3, 1.3), random.between(-0.3, 1.3), random.between(0, 1));
  // One in three stands along the axes, as tools mostly do.
  if (random.next() % 3 != 0)
    pose.linear() = Eigen::Quaterniond(number(), number(), number(), number()).normalized().toRotationMatrix();
  return pose;
}

struct Box {
  Vec3 low, high;
};

Box box_around(const fcl::CollisionGeometryd& shape, const Frame& pose) {
  fcl::CollisionGeometryd& writable = const_cast<fcl::CollisionGeometryd&>(shape);
  writable.computeLocalAABB();
  const Vec3 middle = pose * shape.aabb_center, half = Vec3::Constant(shape.aabb_radius);
  return {middle - half, middle + half};
}

TEST(StandingVoxels, AgreeWithFclOnEveryVoxelByItselfWhileTheyAreCutAndPutBack) {
  std::map<std::uint64_t, int> touching, asked;
  constexpr int sides[] = {4, 8, 16, 32};
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int side = sides[seed % 4];
    const auto voxel = [&] {
      const auto number = [&] { return static_cast<int>(random.next() % static_cast<std::uint64_t>(side)); };
      return Voxel{number(), number(), number()};
    };
    VoxelSet stock(side, seed % 3 == 1);
    for (int at = 0; seed % 3 != 1 && at < side * side; ++at) stock.insert(voxel());
    StandingVoxels standing(stock, voxel_mm, false), thorough(stock, voxel_mm, true);
    for (int round = 0; round < 60; ++round) {
      for (int removal = 0; removal < side; ++removal) {
        const Voxel gone = voxel();
        standing.remove(gone);
        thorough.remove(gone);
        EXPECT_FALSE(standing.contains(gone));
      }
      if (round % 3 == 0) {
        const Voxel back = voxel();
        standing.put_back(back);
        thorough.put_back(back);
        EXPECT_TRUE(standing.contains(back));
      }
      const std::uint64_t kind = random.next() % 5;
      const auto shape = random_shape(random, kind);
      const Frame pose = random_pose(random, side * voxel_mm);
      const auto [low, high] = box_around(*shape, pose);
      const bool touches = standing.touches(*shape, pose, low, high);
      EXPECT_EQ(touches, touches_one_by_one(standing.voxels(), *shape, pose)) << "kind " << kind << ", round " << round;
      EXPECT_EQ(touches, thorough.touches(*shape, pose, low, high)) << "kind " << kind << ", round " << round;
      touching[kind] += touches;
      ++asked[kind];
    }
    EXPECT_EQ(standing.voxels(), thorough.voxels());
    for (int index = 0; index < side * side * side; ++index) {
      standing.remove({index % side, index / side % side, index / side / side});
      thorough.remove({index % side, index / side % side, index / side / side});
    }
    const Vec3 middle = Vec3::Constant(side * voxel_mm / 2);
    for (const StandingVoxels* none : {&standing, &thorough})
      EXPECT_FALSE(none->touches(fcl::Sphered(99), Frame(Eigen::Translation3d{middle}), middle.array() - 99.0,
                                 middle.array() + 99.0));
  }
  for (std::uint64_t kind = 0; kind < 5; ++kind) {
    EXPECT_GT(touching[kind], asked[kind] / 10) << kind;
    EXPECT_LT(touching[kind], asked[kind] * 9 / 10) << kind;
  }
}

TEST(StandingVoxels, AreFoundWhereverTheyStandAlone) {
  for (const int side : {8, 64, 256}) {
    StandingVoxels standing(VoxelSet(side), voxel_mm, false);
    Random random(static_cast<std::uint64_t>(side));
    for (int round = 0; round < 300; ++round) {
      const auto number = [&] { return static_cast<int>(random.next() % static_cast<std::uint64_t>(side)); };
      const Voxel v{number(), number(), number()};
      standing.put_back(v);
      const Vec3 centre = voxel_mm * Vec3(v.i + 0.5, v.j + 0.5, v.k + 0.5);
      // A bar across the whole grid that goes through it, and one that passes beside it.
      const int axis = static_cast<int>(random.next() % 3);
      Vec3 sides = Vec3::Constant(voxel_mm / 2), beside = centre;
      sides[axis] = 4 * side * voxel_mm;
      beside[(axis + 1) % 3] += 0.8 * voxel_mm;
      const fcl::Boxd bar(sides);
      EXPECT_TRUE(standing.touches(bar, Frame(Eigen::Translation3d(centre)), centre - sides / 2, centre + sides / 2));
      EXPECT_FALSE(standing.touches(bar, Frame(Eigen::Translation3d(beside)), beside - sides / 2, beside + sides / 2));
      standing.remove(v);
      EXPECT_FALSE(standing.contains(v));
    }
    EXPECT_EQ(standing.voxels().size(), 0u);
  }
}

}  // namespace
}  // namespace sculpt
