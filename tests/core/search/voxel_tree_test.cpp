#include "core/search/voxel_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

/// L1 to the nearest voxel of a cube.
int l1_to_cube(Voxel from, Voxel corner, int size) {
  const Voxel high = corner + Voxel{1, 1, 1} * (size - 1);
  return l1(from, {std::clamp(from.i, corner.i, high.i), std::clamp(from.j, corner.j, high.j),
                   std::clamp(from.k, corner.k, high.k)});
}

TEST(VoxelTree, TheNearestIsThatOfBruteForceForVoxelsAndForCubes) {
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int n = 8 << seed % 2, size = 1 << seed % 5 % (seed % 2 == 0 ? 4 : 5);
    VoxelTree tree(n, size);
    std::set<Voxel> corners;
    const auto number = [&](int low, int high) { return static_cast<int>(random.between(low, high)); };
    for (int change = 0; change < 200; ++change) {
      const Voxel v{number(0, n), number(0, n), number(0, n)};
      const Voxel corner{v.i / size * size, v.j / size * size, v.k / size * size};
      ASSERT_EQ(tree.contains(v), corners.contains(corner));
      if (corners.erase(corner) > 0) {
        tree.erase(v);
      } else if (random.unit() < 0.5) {
        tree.insert(v);
        corners.insert(corner);
      } else if (!corners.empty()) {
        tree.erase(*corners.begin());
        corners.erase(corners.begin());
      }
      ASSERT_EQ(tree.empty(), corners.empty());
      const Voxel from{number(-1, n + 1), number(-1, n + 1), number(-1, n + 1)};
      const int most = number(1, 4 * n);
      int least = most;
      for (Voxel low : corners) least = std::min(least, l1_to_cube(from, low, size));
      ASSERT_EQ(tree.distance(from, most), least);
      const auto nearest = tree.nearest(from, most);
      ASSERT_EQ(nearest.has_value(), least < most);
      if (!nearest) continue;
      ASSERT_TRUE(corners.contains(nearest->corner));
      ASSERT_EQ(nearest->distance, l1_to_cube(from, nearest->corner, size));
    }
  }
}

}  // namespace
}  // namespace sculpt
