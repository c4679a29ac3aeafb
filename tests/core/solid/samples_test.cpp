// The meshes of config/samples are what a new user tries first.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/material/cavities.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/solid/placement.hpp"
#include "core/solid/voxelize.hpp"

namespace sculpt {
namespace {

VoxelGrid sample(const std::string& name, int n) {
  std::ifstream file(SOURCE_DIR "/config/samples/" + name, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  const Grid grid{n, 0.32 / n, Vec3::Zero()};
  const Mesh mesh = place_mesh(load_mesh(bytes.str(), "stl", 256 << 20, {}), {}, grid);
  return {VoxelSet(n, true), voxelize(mesh, grid, {})};
}

TEST(Samples, EachIsASolidOnTheFloorWithNothingEnclosed) {
  for (const char* name : {"bust.stl", "vase.stl", "dish.stl"})
    for (int n : {16, 64}) {
      SCOPED_TRACE(std::string(name) + " at " + std::to_string(n));
      const VoxelGrid voxels = sample(name, n);
      std::size_t on_floor = 0;
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) on_floor += voxels.keep.contains({i, j, 0});
      EXPECT_GT(on_floor, 0u);
      EXPECT_EQ(find_enclosed(voxels).size(), 0u);
      EXPECT_LT(voxels.keep.size(), static_cast<std::size_t>(n) * n * n / 3);
    }
}

TEST(Samples, TheBellIsHollowUnderneath) {
  for (int n : {16, 64}) {
    const VoxelGrid voxels = sample("bell.stl", n);
    EXPECT_GT(find_enclosed(voxels).size(), voxels.keep.size() / 20) << "shut in between the bell and the table";
    EXPECT_LT(voxels.keep.size(), static_cast<std::size_t>(n) * n * n / 3);
  }
}

TEST(Samples, TheVaseIsHollow) {
  const VoxelGrid voxels = sample("vase.stl", 64);
  EXPECT_FALSE(voxels.keep.contains({32, 32, 32}));
  EXPECT_TRUE(voxels.keep.contains({32, 32, 0}));
}

}  // namespace
}  // namespace sculpt
