#include "core/material/cube_turn.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace sculpt {
namespace {

constexpr int n = 8;

TEST(CubeTurn, IsTheTurnOfAMeshByTheSameAngles) {
  for (const double roll : {0, 90, 180, -90})
    for (const double pitch : {0, 90, 270})
      for (const double yaw : {0, 90, 180}) {
        const Vec3 rad = Vec3(roll, pitch, yaw) * (std::numbers::pi / 180);
        const Eigen::Matrix3d rotation =
            (Eigen::AngleAxisd(rad.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(rad.y(), Vec3::UnitY()) *
             Eigen::AngleAxisd(rad.x(), Vec3::UnitX()))
                .toRotationMatrix();
        const auto turn = cube_turn(rad);
        ASSERT_TRUE(turn);
        for (int axis = 0; axis < 3; ++axis) {
          const Voxel to = turn->axes[static_cast<std::size_t>(axis)];
          EXPECT_LT((rotation.col(axis) - Vec3(to.i, to.j, to.k)).norm(), 1e-9) << roll << " " << pitch << " " << yaw;
        }
      }
}

TEST(CubeTurn, OnlyQuartersAreOne) {
  EXPECT_FALSE(cube_turn({std::numbers::pi / 4, 0, 0}));
  EXPECT_FALSE(cube_turn({0, 1e-5, 0}));
  EXPECT_TRUE(cube_turn({0, 1e-9, 1.5707963})) << "a quarter as somebody writes it";
  EXPECT_FALSE(cube_turn({0, 0, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(CubeTurn, FourQuartersAreNone) {
  VoxelSet set(n);
  for (const Voxel v : {Voxel{0, 1, 2}, Voxel{7, 7, 0}, Voxel{3, 4, 6}}) set.insert(v);
  for (const Vec3& quarter : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    VoxelSet turned = set;
    for (int time = 0; time < 4; ++time) {
      turned = cube_turn(quarter * (std::numbers::pi / 2))->of(turned);
      EXPECT_EQ(turned.size(), set.size());
    }
    EXPECT_EQ(turned, set);
  }
  EXPECT_EQ(cube_turn({std::numbers::pi, 0, 0})->of(Voxel{1, 2, 3}, n), (Voxel{1, n - 3, n - 4}));
}

TEST(CubeTurn, WhatIsLoweredStandsOnTheFloor) {
  VoxelSet set(n);
  for (const Voxel v : {Voxel{0, 1, 2}, Voxel{7, 7, 5}}) set.insert(v);
  EXPECT_EQ(lowest_layer(set), 2);
  const VoxelSet down = lowered(set, 2);
  EXPECT_TRUE(down.contains({0, 1, 0}));
  EXPECT_TRUE(down.contains({7, 7, 3}));
  EXPECT_EQ(down.size(), 2u);
  EXPECT_EQ(lowest_layer(VoxelSet(n)), 0);
}

}  // namespace
}  // namespace sculpt
