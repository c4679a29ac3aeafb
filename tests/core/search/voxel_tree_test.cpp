#include "core/search/voxel_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

TEST(VoxelTree, TheDistanceToTheNearestIsThatOfBruteForce) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int n = 8 << seed % 2;
    VoxelTree tree(n);
    std::set<Voxel> voxels;
    const auto number = [&](int low, int high) { return static_cast<int>(random.between(low, high)); };
    for (int change = 0; change < 200; ++change) {
      const Voxel v{number(0, n), number(0, n), number(0, n)};
      ASSERT_EQ(tree.contains(v), voxels.contains(v));
      if (voxels.erase(v) > 0) {
        tree.erase(v);
      } else if (random.unit() < 0.5) {
        tree.insert(v);
        voxels.insert(v);
      } else if (!voxels.empty()) {
        tree.erase(*voxels.begin());
        voxels.erase(voxels.begin());
      }
      ASSERT_EQ(tree.empty(), voxels.empty());
      const Voxel from{number(-1, n + 1), number(-1, n + 1), number(-1, n + 1)};
      const int most = number(1, 4 * n);
      int least = most;
      for (Voxel voxel : voxels) least = std::min(least, l1(voxel, from));
      ASSERT_EQ(tree.distance(from, most), least);
    }
  }
}

}  // namespace
}  // namespace sculpt
