#include "core/material/support/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <new>

#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

std::vector<Voxel> members(const VoxelSet& set) {
  std::vector<Voxel> all;
  for (int k = 0; k < set.n(); ++k)
    for (int j = 0; j < set.n(); ++j)
      for (int i = 0; i < set.n(); ++i)
        if (set.contains({i, j, k})) all.push_back({i, j, k});
  return all;
}

/// What a plain flood from layer 0 does not come to.
VoxelSet unsupported(const VoxelSet& standing) {
  const Grid bounds{standing.n(), 1, Vec3::Zero()};
  VoxelSet left = standing;
  std::vector<Voxel> queue;
  for (Voxel voxel : members(standing))
    if (voxel.k == 0) {
      left.erase(voxel);
      queue.push_back(voxel);
    }
  for (std::size_t at = 0; at < queue.size(); ++at)
    for (Voxel step : face_steps) {
      const Voxel next = queue[at] + step;
      if (!bounds.contains(next) || !left.contains(next)) continue;
      left.erase(next);
      queue.push_back(next);
    }
  return left;
}

std::size_t count_supported(const VoxelSet& standing) {
  return standing.size() - unsupported(standing).size();
}

bool frees_by_brute_force(const VoxelSet& standing, const VoxelSet& may_fall, Voxel voxel) {
  VoxelSet after = standing;
  after.erase(voxel);
  const VoxelSet before = unsupported(standing);
  const std::vector<Voxel> now = members(unsupported(after));
  return std::any_of(now.begin(), now.end(),
                     [&](Voxel each) { return !before.contains(each) && !may_fall.contains(each); });
}

/// Mushroom, bridge, ring on a post, block on a neck, comb, blobs, noise, a full cube.
VoxelSet shape(int n, std::uint64_t seed) {
  VoxelSet set(n);
  const int last = n - 1, half = n / 2;
  switch (seed % 8) {
    case 0:
      shapes::fill(set, {half, half, 0}, {half, half, last});
      shapes::fill(set, {0, 0, half}, {last, last, half + 1});
      return set;
    case 1:
      shapes::fill(set, {0, half, 0}, {0, half, last});
      shapes::fill(set, {last, half, 0}, {last, half, last});
      shapes::fill(set, {0, half, last - 1}, {last, half, last - 1});
      return set;
    case 2:
      shapes::fill(set, {0, 0, half}, {last, last, half});
      for (int j = 1; j < last; ++j)
        for (int i = 1; i < last; ++i) set.erase({i, j, half});
      shapes::fill(set, {0, 0, 0}, {0, 0, half});
      return set;
    case 3:
      shapes::fill(set, {1, 1, half}, {last, last, last});
      shapes::fill(set, {2, 2, 0}, {2, 2, half});
      return set;
    case 4:
      shapes::fill(set, {0, 0, 0}, {last, 0, last});
      for (int i = 0; i < n; i += 2) shapes::fill(set, {i, 0, 1}, {i, last, last});
      return set;
    case 5:
    case 6:
      return shapes::random_grid(n, seed).stock;
    default:
      return VoxelSet(n, true);
  }
}

TEST(Support, FreesWhatAPlainFloodAfterTheRemovalSaysInAnyOrder) {
  int frees = 0, does_not = 0;
  for (std::uint64_t seed = 0; seed < 160; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int n = seed % 3 == 0 ? 8 : 4;
    VoxelSet may_fall(n);
    if (seed % 5 == 0) shapes::fill(may_fall, {1, 0, 1}, {n - 1, n / 2, n - 1});
    Support support(shape(n, seed), may_fall);
    std::vector<Voxel> order = members(support.standing()), removed;
    for (std::size_t at = order.size(); at > 1; --at) std::swap(order[at - 1], order[random.next() % at]);
    for (Voxel voxel : order) {
      const bool expected = frees_by_brute_force(support.standing(), may_fall, voxel);
      ASSERT_EQ(support.frees(voxel), expected) << voxel.i << " " << voxel.j << " " << voxel.k;
      (expected ? frees : does_not) += 1;
      if (expected) continue;
      support.remove(voxel);
      removed.push_back(voxel);
      if (random.unit() < 0.05) {  // the last few, as a sweep takes them back
        for (int back = 0; back < 4 && !removed.empty(); ++back, removed.pop_back()) support.restore(removed.back());
      }
    }
  }
  EXPECT_GT(frees, 500);
  EXPECT_GT(does_not, 5000);
}

TEST(Support, WhatIsHeldStaysHeldAllTheWayDown) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Support support(shape(16, seed), VoxelSet(16));
    const std::size_t loose = support.standing().size() - count_supported(support.standing());
    bool again = true;
    while (again) {
      again = false;
      for (Voxel voxel : members(support.standing()))
        if (voxel.k > 0 && !support.frees(voxel)) {
          support.remove(voxel);
          again = true;
        }
      ASSERT_GE(count_supported(support.standing()) + loose, support.standing().size());
    }
  }
}

TEST(Support, ALineIsCutUpToWhatHoldsTheRest) {
  VoxelSet gallows(8);
  shapes::fill(gallows, {2, 2, 0}, {2, 2, 4});
  shapes::fill(gallows, {3, 2, 4}, {7, 2, 4});
  Support support(gallows, VoxelSet(8));
  EXPECT_EQ(support.remove(VoxelLine{{3, 2, 4}, {7, 2, 4}}), 0);
  EXPECT_EQ(support.standing(), gallows);
  EXPECT_EQ(support.remove(VoxelLine{{2, 2, 4}, {2, 2, 0}}), 0);
  EXPECT_EQ(support.remove(VoxelLine{{7, 2, 4}, {3, 2, 4}}), 5);
  EXPECT_EQ(support.remove(VoxelLine{{2, 2, 4}, {2, 2, 0}}), 5);
  EXPECT_EQ(support.standing().size(), 0u);
}

/// Cubes of voxels that all stand are passed in one step: thick blocks on thin posts, joined by thin rods.
TEST(Support, WhatHangsOnThickPartsIsHeldAsAPlainFloodSays) {
  int frees = 0, does_not = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int n = 32;
    VoxelSet blocks(n), rods(n), may_fall(n);
    const auto within = [&](int from, int to) { return static_cast<int>(random.between(from, to + 1)); };
    for (const Voxel low : {Voxel{2, 2, 10}, Voxel{17, 2, 10}, Voxel{2, 17, 10}}) {
      shapes::fill(blocks, low, low + Voxel{within(9, 12), within(9, 12), within(8, 20)});
      for (int post = within(0, 1); post > 0; --post) {
        const int i = low.i + within(0, 8), j = low.j + within(0, 8);
        shapes::fill(rods, {i, j, 0}, {i, j, 9});
      }
    }
    for (int rod = within(1, 2); rod > 0; --rod) {
      const int across = within(3, 10), k = within(11, 17);
      shapes::fill(rods, {10, across, k}, {20, across, k});
    }
    for (int rod = within(1, 2); rod > 0; --rod) {
      const int across = within(3, 10), k = within(11, 17);
      shapes::fill(rods, {across, 10, k}, {across, 20, k});
    }
    if (seed % 4 == 0) shapes::fill(may_fall, {0, 0, 8}, {31, 15, 31});
    VoxelSet set = blocks;
    for (const Voxel voxel : members(rods)) set.insert(voxel);
    const Support support(set, may_fall);
    for (const Voxel voxel : members(rods)) {
      const bool expected = frees_by_brute_force(set, may_fall, voxel);
      ASSERT_EQ(support.frees(voxel), expected) << voxel.i << " " << voxel.j << " " << voxel.k;
      (expected ? frees : does_not) += 1;
    }
  }
  EXPECT_GT(frees, 300);
  EXPECT_GT(does_not, 300);
}

/// Far from any column that stands on the table, and too large for anything but a flood of the whole grid.
TEST(Support, ALargeOverhangIsFollowedToItsOnlyPost) {
  VoxelSet table(64);
  shapes::fill(table, {0, 0, 40}, {63, 63, 43});
  shapes::fill(table, {0, 0, 0}, {0, 0, 39});
  shapes::fill(table, {63, 63, 30}, {63, 63, 39});
  Support support(table, VoxelSet(64));
  EXPECT_TRUE(support.frees({63, 63, 39}));
  EXPECT_TRUE(support.frees({0, 0, 20}));
  EXPECT_FALSE(support.frees({63, 63, 30}));
  EXPECT_FALSE(support.frees({32, 32, 41}));
  shapes::fill(table, {20, 0, 0}, {20, 0, 39});
  EXPECT_FALSE(Support(table, VoxelSet(64)).frees({0, 0, 20})) << "the other post holds all";
}

TEST(Support, WhatWasInItsMemoryBeforeChangesNothing) {
  // A post of three voxels with one more hanging beside its top. Its height once made the count of what hangs zero.
  VoxelSet standing(4);
  shapes::fill(standing, {1, 1, 0}, {1, 1, 2});
  standing.insert({2, 1, 2});
  alignas(Support) std::array<std::int64_t, (sizeof(Support) + 7) / 8> memory;
  for (std::int64_t value : {0, 3, 4, -1}) {
    memory.fill(value);
    auto* support = new (memory.data()) Support(standing, VoxelSet(4));
    EXPECT_EQ(support->remove(VoxelLine{{1, 1, 2}, {1, 1, 2}}), 0) << "memory " << value;
    support->~Support();
  }
}

}  // namespace
}  // namespace sculpt
