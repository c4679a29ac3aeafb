#include "core/material/octree.hpp"

#include <gtest/gtest.h>

#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

std::uint64_t morton(Voxel v) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < 10; ++bit)
    code |= static_cast<std::uint64_t>((v.i >> bit & 1) | (v.j >> bit & 1) << 1 | (v.k >> bit & 1) << 2) << (3 * bit);
  return code;
}

bool uniform(const VoxelGrid& grid, Voxel corner, int size) {
  for (int k = 0; k < size; ++k)
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i)
        if (grid.label(corner + Voxel{i, j, k}) != grid.label(corner)) return false;
  return true;
}

void expect_leaves_by_brute_force(const VoxelGrid& grid, Voxel corner, int size, std::vector<Block>& leaves) {
  if (uniform(grid, corner, size)) {
    leaves.push_back({corner, size, grid.label(corner)});
    return;
  }
  for (int child = 0; child < 8; ++child)
    expect_leaves_by_brute_force(grid, corner + Voxel{child & 1, child >> 1 & 1, child >> 2} * (size / 2), size / 2,
                                 leaves);
}

TEST(Octree, LeavesAreThoseOfTheDefinition) {
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid grid = shapes::random_grid(seed % 10 == 9 ? 64 : 8 << seed % 3, seed);
    const Octree octree = build_octree(grid, {});
    std::vector<Block> expected;
    expect_leaves_by_brute_force(grid, {0, 0, 0}, grid.n(), expected);
    ASSERT_EQ(octree.leaves.size(), expected.size());
    for (std::size_t at = 0; at < expected.size(); ++at) {
      ASSERT_EQ(octree.leaves[at].corner, expected[at].corner);
      ASSERT_EQ(octree.leaves[at].size, expected[at].size);
      ASSERT_EQ(octree.leaves[at].label, expected[at].label);
    }
  }
}

TEST(Octree, EveryVoxelLiesInExactlyOneLeafAndFindNamesIt) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid grid = shapes::random_grid(8 << seed % 3, seed);
    const Octree octree = build_octree(grid, {});
    std::uint64_t volume = 0;
    for (const Block& leaf : octree.leaves) volume += static_cast<std::uint64_t>(leaf.size) * leaf.size * leaf.size;
    EXPECT_EQ(volume, static_cast<std::uint64_t>(grid.n()) * grid.n() * grid.n());
    for (int k = 0; k < grid.n(); ++k)
      for (int j = 0; j < grid.n(); ++j)
        for (int i = 0; i < grid.n(); ++i) {
          const Block& leaf = octree.leaves[octree.find({i, j, k})];
          ASSERT_TRUE(leaf.contains({i, j, k}));
          ASSERT_EQ(leaf.label, grid.label({i, j, k}));
        }
  }
}

TEST(Octree, LeavesAreSortedByMortonCode) {
  const Octree octree = build_octree(shapes::random_grid(64, 4), {});
  for (std::size_t at = 1; at < octree.leaves.size(); ++at)
    ASSERT_LT(morton(octree.leaves[at - 1].corner), morton(octree.leaves[at].corner));
}

TEST(Octree, AnUntouchedStockIsOneLeaf) {
  const Octree octree = build_octree({VoxelSet(256, true), VoxelSet(256)}, {});
  ASSERT_EQ(octree.leaves.size(), 1u);
  EXPECT_EQ(octree.leaves[0].size, 256);
  EXPECT_EQ(octree.leaves[0].label, Label::remove);
  EXPECT_EQ(octree.find({255, 0, 17}), 0);
}

TEST(Octree, OneKeptVoxelSplitsEveryLevelOnce) {
  VoxelGrid grid{VoxelSet(128, true), VoxelSet(128)};
  grid.keep.insert({77, 3, 127});
  const Octree octree = build_octree(grid, {});
  EXPECT_EQ(octree.leaves.size(), 7u * 7u + 1u);
  EXPECT_EQ(octree.leaves[octree.find({77, 3, 127})].label, Label::keep);
}

TEST(Octree, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(build_octree({VoxelSet(64, true), VoxelSet(64)}, {source.get_token(), nullptr}), Cancelled);
}

}  // namespace
}  // namespace sculpt
