#include "core/solid/touched_voxels.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

constexpr int n = 8, samples = 60;
const Grid grid{n, 0.01, Vec3(0.3, -0.2, 0.1)};

/// Some of it may be beside the grid.
Mesh facet_of_chance(Random& random) {
  Mesh mesh;
  for (int corner = 0; corner < 3; ++corner)
    mesh.vertices.push_back(grid.origin_m +
                            grid.voxel_m * (Vec3(random.unit(), random.unit(), random.unit()) * 10 - Vec3::Ones()));
  mesh.triangles.push_back({0, 1, 2});
  return mesh;
}

/// Evenly over a facet, in voxels.
template <typename Visit>
void for_each_sample(const Mesh& facet, const Visit& visit) {
  for (int a = 0; a <= samples; ++a)
    for (int b = 0; a + b <= samples; ++b) {
      const Vec3 at = (a * facet.vertices[0] + b * facet.vertices[1] + (samples - a - b) * facet.vertices[2]) / samples;
      visit((at - grid.origin_m) / grid.voxel_m);
    }
}

TEST(TouchedVoxels, HoldEveryPointOfAFacetAndNoneIsFarFromIt) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Mesh facet = facet_of_chance(random);
    const VoxelSet touched = touched_voxels(facet, grid, {});
    VoxelSet near(n);
    for_each_sample(facet, [&](const Vec3& at) {
      for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i)
            if (((at - Vec3(i, j, k)).array() > -0.2).all() && ((at - Vec3(i, j, k)).array() < 1.2).all())
              near.insert({i, j, k});
      const Voxel voxel{static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
                        static_cast<int>(std::floor(at.z()))};
      const Vec3 in = at - Vec3(voxel.i, voxel.j, voxel.k);
      const bool is_inside = grid.contains(voxel) && (in.array() > 1e-5).all() && (in.array() < 1 - 1e-5).all();
      EXPECT_TRUE(!is_inside || touched.contains(voxel)) << at.transpose();
    });
    VoxelSet far = touched;
    far -= near;
    EXPECT_EQ(far.size(), 0u);
  }
}

TEST(TouchedVoxels, AreNoneBesideASurfaceBetweenVoxels) {
  Mesh square;
  for (const auto& [x, y] : {std::pair{1, 1}, {5, 1}, {5, 5}, {1, 5}})
    square.vertices.push_back(grid.origin_m + grid.voxel_m * Vec3(x, y, 3));
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(touched_voxels(square, grid, {}).size(), 0u);
}

TEST(TouchedVoxels, CanBeStopped) {
  std::stop_source stop;
  stop.request_stop();
  Random random(1);
  EXPECT_THROW(touched_voxels(facet_of_chance(random), grid, {stop.get_token(), {}, {}}), Cancelled);
}

}  // namespace
}  // namespace sculpt
