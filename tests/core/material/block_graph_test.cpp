#include "core/material/block_graph.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

/// Two blocks are neighbours when two of their voxels share a face.
std::vector<std::set<std::uint32_t>> neighbours_by_brute_force(const Octree& octree) {
  const int n = octree.n;
  std::vector<std::uint32_t> owner(static_cast<std::size_t>(n) * n * n);
  const auto at = [n](Voxel v) { return v.i + n * (v.j + n * v.k); };
  for (std::uint32_t id = 0; id < octree.leaves.size(); ++id) {
    const Block& leaf = octree.leaves[id];
    for (int k = 0; k < leaf.size; ++k)
      for (int j = 0; j < leaf.size; ++j)
        for (int i = 0; i < leaf.size; ++i) owner[at(leaf.corner + Voxel{i, j, k})] = id;
  }
  std::vector<std::set<std::uint32_t>> neighbours(octree.leaves.size());
  const Grid grid{n, 1, Vec3::Zero()};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (Voxel step : face_steps) {
          const Voxel here{i, j, k}, beside = here + step;
          if (grid.contains(beside) && owner[at(here)] != owner[at(beside)])
            neighbours[owner[at(here)]].insert(owner[at(beside)]);
        }
  return neighbours;
}

TEST(BlockGraph, NeighboursAreThoseThatShareAFace) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Octree octree = build_octree(shapes::random_grid(seed % 15 == 14 ? 64 : 8 << seed % 3, seed), {});
    const BlockGraph graph = build_block_graph(octree, {});
    const auto expected = neighbours_by_brute_force(octree);
    for (std::size_t id = 0; id < expected.size(); ++id) {
      const auto found = graph.of(static_cast<int>(id));
      ASSERT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()),
                std::vector<std::uint32_t>(expected[id].begin(), expected[id].end()))
          << "block " << id;
    }
  }
}

TEST(BlockGraph, ASingleBlockHasNoNeighbours) {
  const BlockGraph graph = build_block_graph(build_octree({VoxelSet(8, true), VoxelSet(8)}, {}), {});
  EXPECT_TRUE(graph.of(0).empty());
}

TEST(BlockGraph, ABlockMayHaveMoreThanSixNeighbours) {
  VoxelGrid grid{VoxelSet(8, true), VoxelSet(8)};
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k)
      if ((j + k) % 2 == 0) grid.keep.insert({4, j, k});
  const Octree octree = build_octree(grid, {});
  const BlockGraph graph = build_block_graph(octree, {});
  EXPECT_EQ(octree.leaves[octree.find({0, 0, 0})].size, 4);
  EXPECT_EQ(graph.of(octree.find({0, 0, 0})).size(), 16u + 2u);
}

TEST(BlockGraph, StopsWhenAsked) {
  const Octree octree = build_octree(shapes::random_grid(32, 1), {});
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(build_block_graph(octree, {source.get_token(), nullptr}), Cancelled);
}

}  // namespace
}  // namespace sculpt
