// The replay's flood, against one voxel after the other.
#include "core/verify/material/reached.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/material/random_voxels.hpp"

namespace sculpt {
namespace {

VoxelSet reached_one_by_one(const VoxelSet& open, const VoxelSet& seeds) {
  const Grid grid{open.n(), 1, Vec3::Zero()};
  VoxelSet reached(open.n());
  std::vector<Voxel> waiting;
  const auto reach = [&](Voxel v) {
    if (!grid.contains(v) || !open.contains(v) || reached.contains(v)) return;
    reached.insert(v);
    waiting.push_back(v);
  };
  for_each_voxel(seeds, reach);
  while (!waiting.empty()) {
    const Voxel from = waiting.back();
    waiting.pop_back();
    for (const Voxel step : face_steps) reach(from + step);
  }
  return reached;
}

TEST(Reached, IsWhatOneVoxelAfterTheOtherComesTo) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int n = std::vector{4, 8, 16, 32, 64}[seed % 5];
    // Around a third, where voxels just hang together, ways are longest.
    const VoxelSet open = random_voxels(n, 0.2 + 0.5 * random.unit(), random),
                   seeds = random_voxels(n, 2.0 / n / n, random);
    ASSERT_EQ(reached_through(open, seeds), reached_one_by_one(open, seeds));
  }
}

TEST(Reached, GoesThroughAllChunksOfARowAndBack) {
  for (const int start : {0, 63, 64, 127}) {
    VoxelSet open(128), seeds(128);
    for (int i = 0; i < 128; ++i) open.insert({i, 5, 7});
    seeds.insert({start, 5, 7});
    EXPECT_EQ(reached_through(open, seeds), open) << start;
  }
}

/// A channel one voxel wide that turns back at every wall.
TEST(Reached, FollowsAMeander) {
  constexpr int n = 32;
  VoxelSet open(n, true), seeds(n);
  for (int j = 1; j < n; j += 2)
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n; ++i) open.erase({i, j, k});
  for (int j = 1; j < n; j += 2) open.insert({j % 4 == 1 ? 0 : n - 1, j, j % 4 == 1 ? n - 1 : 0});
  seeds.insert({n / 2, n - 2, n / 2});
  EXPECT_EQ(reached_through(open, seeds), open);
  open.erase({n - 1, 3, 0});
  EXPECT_EQ(reached_through(open, seeds), reached_one_by_one(open, seeds));
  EXPECT_FALSE(reached_through(open, seeds).contains({0, 0, 0}));
}

}  // namespace
}  // namespace sculpt
