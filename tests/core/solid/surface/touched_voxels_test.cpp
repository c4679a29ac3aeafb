#include "core/solid/surface/touched_voxels.hpp"

#include <gtest/gtest.h>

#include <optional>

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

/// All whose cubes, a little larger, hold a point (in voxels).
void add_near(const Vec3& at, VoxelSet& near) {
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (((at - Vec3(i, j, k)).array() - 0.5).abs().maxCoeff() < 0.7) near.insert({i, j, k});
}

/// In which a point is, well away from its sides.
std::optional<Voxel> voxel_around(const Vec3& at) {
  const Eigen::Array3d low = at.array().floor(), in = at.array() - low;
  const Voxel voxel{static_cast<int>(low.x()), static_cast<int>(low.y()), static_cast<int>(low.z())};
  if (!grid.contains(voxel) || (in - 0.5).abs().maxCoeff() > 0.5 - 1e-5) return std::nullopt;
  return voxel;
}

TEST(TouchedVoxels, HoldEveryPointOfAFacetAndNoneIsFarFromIt) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Mesh facet = facet_of_chance(random);
    const VoxelSet touched = touched_voxels(facet, grid, {});
    VoxelSet near(n);
    for_each_sample(facet, [&](const Vec3& at) {
      add_near(at, near);
      const auto voxel = voxel_around(at);
      EXPECT_TRUE(!voxel || touched.contains(*voxel)) << at.transpose();
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
