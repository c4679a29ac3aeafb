#include "core/search/nearest_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "core/base/random.hpp"
#include "tests/core/search/replay.hpp"

namespace sculpt {
namespace {

int l1_to(const Block& block, Voxel from) {
  int least = 1 << 30;
  for (int k = 0; k < block.size; ++k)
    for (int j = 0; j < block.size; ++j)
      for (int i = 0; i < block.size; ++i) least = std::min(least, l1(block.corner + Voxel{i, j, k}, from));
  return least;
}

/// What greedy best-first ranks by, ties included: distance less volume, larger blocks first.
std::tuple<int, int> rank(const Block& block, Voxel from) {
  return {l1_to(block, from) - block.size * block.size * block.size, -block.size};
}

TEST(NearestBlocks, TheBestAndTheNearestAreThoseOfLookingAtAll) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int n = 8 << seed % 3;
    const Octree octree = build_octree(random_voxels(n, seed), {});
    NearestBlocks blocks(n);
    std::vector<Block> candidates;
    for (int step = 0; step < 150; ++step) {
      Block block =
          octree.leaves[static_cast<std::size_t>(random.between(0, static_cast<double>(octree.leaves.size())))];
      block.label = Label::remove;
      const auto known = std::find(candidates.begin(), candidates.end(), block);
      if (known == candidates.end()) {
        candidates.push_back(block);
        blocks.insert(block);
      } else {
        candidates.erase(known);
        blocks.erase(block);
      }
      ASSERT_EQ(blocks.empty(), candidates.empty());
      if (candidates.empty()) continue;
      const auto place = [&] { return static_cast<int>(random.between(-1, n + 1)); };
      const Voxel from{place(), place(), place()};
      const Block best = blocks.best(from);
      ASSERT_NE(std::find(candidates.begin(), candidates.end(), best), candidates.end());
      for (const Block& other : candidates) ASSERT_LE(rank(best, from), rank(other, from));

      const int most = static_cast<int>(random.between(1, 2 * n));
      const auto nearest = blocks.nearest(from, most);
      int least = most;
      for (const Block& other : candidates) least = std::min(least, l1_to(other, from));
      ASSERT_EQ(nearest.has_value(), least < most);
      if (!nearest) continue;
      ASSERT_NE(std::find(candidates.begin(), candidates.end(), *nearest), candidates.end());
      ASSERT_EQ(l1_to(*nearest, from), least);
    }
  }
}

}  // namespace
}  // namespace sculpt
