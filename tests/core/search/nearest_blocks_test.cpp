#include "core/search/nearest_blocks.hpp"

#include <gtest/gtest.h>

#include <set>
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

std::uint32_t best_by_brute_force(const Octree& octree, const std::set<std::uint32_t>& candidates, Voxel from) {
  std::tuple<int, int, std::uint32_t> best{1 << 30, 0, 0};
  for (std::uint32_t id : candidates) {
    const Block& block = octree.leaves[id];
    best = std::min(best, {l1_to(block, from) - block.size * block.size * block.size, -block.size, id});
  }
  return std::get<2>(best);
}

TEST(NearestBlocks, TheBestIsThatOfLookingAtAll) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int n = 8 << seed % 3;
    const Octree octree = build_octree(random_voxels(n, seed), {});
    NearestBlocks blocks(octree);
    std::set<std::uint32_t> candidates;
    for (int step = 0; step < 150; ++step) {
      const auto id = static_cast<std::uint32_t>(random.between(0, static_cast<double>(octree.leaves.size())));
      if (candidates.insert(id).second) {
        blocks.insert(id);
      } else {
        candidates.erase(id);
        blocks.erase(id);
      }
      ASSERT_EQ(blocks.empty(), candidates.empty());
      if (candidates.empty()) continue;
      const auto place = [&] { return static_cast<int>(random.between(-1, n + 1)); };
      const Voxel from{place(), place(), place()};
      ASSERT_EQ(blocks.best(from), best_by_brute_force(octree, candidates, from));
    }
  }
}

}  // namespace
}  // namespace sculpt
