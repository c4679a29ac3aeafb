#include "core/collision/clearance.hpp"

#include <gtest/gtest.h>

#include "tests/core/cell/sample_robots.hpp"
#include "tests/core/collision/random_bodies.hpp"

namespace sculpt {
namespace {

// FCL shares nothing with the trees and planes that bodies are asked by.
TEST(Clearance, OfBodiesIsThatOfTheirShapesAsFclMeasuresIt) {
  int near = 0, far = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Shape first = random_shape(random), second = random_shape(random);
    const Frame pose = random_pose(random, 0.3), other = random_pose(random, 0.2);
    const double distance_m = FclPair(first, second).distance_m(pose, other);
    const Body one = body_of(first), two = body_of(second);
    const double reach = random.between(0, 0.2);
    const bool is_near = near_body(one, pose, two, other, reach);
    EXPECT_EQ(is_near, near_body(two, other, one, pose, reach));
    if (distance_m < reach - 1e-4) {
      ++near;
      EXPECT_TRUE(is_near) << distance_m << " " << reach;
    }
    // A home is not refused where two links are 2 mm apart, or 2 % of the distance.
    if (distance_m > 1.02 * reach + 0.002) {
      ++far;
      EXPECT_FALSE(is_near) << distance_m << " " << reach;
    }
    EXPECT_LE(hull_distance(one, pose, two, other), distance_m + 1e-4);
  }
  EXPECT_GT(near, 300);
  EXPECT_GT(far, 300);
}

TEST(Clearance, ABodyTouchesItself) {
  const Cell cell = shipped_cell("panda-turntable");
  const std::vector<Body> bodies = make_bodies(cell, make_tool(cell.tool, 0.01));
  EXPECT_TRUE(near_body(bodies[0], Frame::Identity(), bodies[0], Frame::Identity(), 0));
}

TEST(Clearance, OfMaterialAndOfTheStockAsABodyIsTheSameForWholeBlocks) {
  int near = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Grid grid{16, 0.02, Vec3(-0.16, -0.16, 0)};
    VoxelSet standing(16);
    const int blocks = static_cast<int>(random.between(0, 12));
    for (int block = 0; block < blocks; ++block) {
      const int size = random.unit() < 0.5 ? 2 : 4;
      const Voxel at{static_cast<int>(random.between(0, 16.0 / size)), static_cast<int>(random.between(0, 16.0 / size)),
                     static_cast<int>(random.between(0, 16.0 / size))};
      for (int i = 0; i < size * size * size; ++i)
        standing.insert(at * size + Voxel{i % size, i / size % size, i / size / size});
    }
    const Material material(standing);
    const Body body = body_of(random_shape(random)), stock = make_stock_body(material, grid, 1);
    const Frame pose = random_pose(random, 0.4);
    const double reach = random.between(0, 0.05);
    const bool is_near = near_material(body, pose, material, grid, reach);
    near += is_near;
    EXPECT_EQ(is_near, near_body(body, pose, stock, Frame::Identity(), reach));
  }
  EXPECT_GT(near, 50);
  EXPECT_LT(near, 350);
}

}  // namespace
}  // namespace sculpt
