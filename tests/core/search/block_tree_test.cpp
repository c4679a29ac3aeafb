#include "core/search/block_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

TEST(BlockTree, TheNearestIsThatOfBruteForceForBlocksOfAllSizes) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto number = [&](int low, int high) { return static_cast<int>(random.between(low, high)); };
    const int n = 8 << seed % 2, log_n = seed % 2 == 0 ? 3 : 4;
    BlockTree tree(n);
    std::vector<Block> blocks;
    for (int change = 0; change < 200; ++change) {
      const int size = 1 << number(0, seed % 4 == 0 ? log_n + 1 : log_n);
      const auto aligned = [&] { return number(0, n) / size * size; };
      const Block block{{aligned(), aligned(), aligned()}, size, Label::remove};
      const bool apart = std::none_of(blocks.begin(), blocks.end(), [&](const Block& other) {
        return block.contains(other.corner) || other.contains(block.corner);
      });
      if (apart && random.unit() < 0.6) {
        tree.insert(block);
        blocks.push_back(block);
      } else if (!blocks.empty()) {
        const auto gone = blocks.begin() + number(0, static_cast<int>(blocks.size()));
        tree.erase(*gone);
        blocks.erase(gone);
      }
      const Voxel from{number(-1, n + 1), number(-1, n + 1), number(-1, n + 1)};
      const int most = number(1, change % 2 == 0 ? 4 : 4 * n);
      int least = most;
      for (const Block& each : blocks) least = std::min(least, each.distance(from));
      const auto nearest = tree.nearest(from, most);
      ASSERT_EQ(nearest.has_value(), least < most);
      if (!nearest) continue;
      const Block found{nearest->corner, nearest->size, Label::remove};
      ASSERT_TRUE(std::find(blocks.begin(), blocks.end(), found) != blocks.end());
      ASSERT_EQ(nearest->distance, least);
      ASSERT_EQ(found.distance(from), least);
    }
  }
}

}  // namespace
}  // namespace sculpt
