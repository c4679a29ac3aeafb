// The outer search with a robot that is a function.
#include "core/search/block_order.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

struct Space {
  Octree octree;
  BlockGraph graph;
};

Space make_space(const VoxelGrid& voxels) {
  Space space;
  space.octree = build_octree(voxels, {});
  space.graph = build_block_graph(space.octree, {});
  return space;
}

VoxelGrid random_grid(int n, std::uint64_t seed) {
  Random random(seed);
  VoxelGrid voxels{VoxelSet(n, true), VoxelSet(n)};
  for (int r = 0; r < n * n; ++r)
    voxels.keep.insert({static_cast<int>(random.next() % n), static_cast<int>(random.next() % n),
                        static_cast<int>(random.next() % n)});
  return voxels;
}

int volume(const Block& block) {
  return block.size * block.size * block.size;
}

/// Takes every block whole; notes the order.
struct EagerRobot {
  const Octree& octree;
  std::vector<int> order;
  BlockTrial operator()(int block, int) {
    order.push_back(block);
    const Block& b = octree.leaves[static_cast<std::size_t>(block)];
    return {volume(b), 0, b.corner};
  }
};

TEST(BlockOrder, EveryReachableRemoveBlockComesExactlyOnceAndOnlyWithAnOpenFace) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid voxels = random_grid(16, seed);
    const Space space = make_space(voxels);
    EagerRobot robot{space.octree, {}};
    order_blocks(space.octree, space.graph, {0, 0, 15}, 2, std::ref(robot), {});
    std::set<int> done;
    for (int block : robot.order) {
      const Block& b = space.octree.leaves[static_cast<std::size_t>(block)];
      EXPECT_EQ(b.label, Label::remove);
      const auto at_side = [&](int low) { return low == 0 || low + b.size == 16; };
      bool open = at_side(b.corner.i) || at_side(b.corner.j) || b.corner.k + b.size == 16;
      for (std::uint32_t near : space.graph.of(block)) open = open || done.count(static_cast<int>(near)) > 0;
      EXPECT_TRUE(open);
      EXPECT_TRUE(done.insert(block).second) << "twice";
    }
  }
}

TEST(BlockOrder, LargerBlocksComeFirstAndNearerOnesAmongEquals) {
  VoxelGrid voxels{VoxelSet(8, true), VoxelSet(8)};
  voxels.keep.insert({0, 0, 0});
  const Space space = make_space(voxels);
  EagerRobot robot{space.octree, {}};
  order_blocks(space.octree, space.graph, {0, 0, 7}, 0, std::ref(robot), {});
  ASSERT_FALSE(robot.order.empty());
  const Block& first = space.octree.leaves[static_cast<std::size_t>(robot.order.front())];
  EXPECT_EQ(first.size, 4);
  EXPECT_EQ(first.corner, (Voxel{0, 0, 4})) << "the one the tool stands at";
  for (std::size_t i = 1; i < robot.order.size(); ++i)
    EXPECT_GE(space.octree.leaves[static_cast<std::size_t>(robot.order[i - 1])].size,
              space.octree.leaves[static_cast<std::size_t>(robot.order[i])].size);
}

TEST(BlockOrder, ABlockThatFailsIsTriedAgainAfterItsNeighbourIsGone) {
  VoxelGrid voxels{VoxelSet(8, true), VoxelSet(8, true)};
  for (Voxel v : {Voxel{0, 0, 7}, Voxel{1, 0, 7}}) voxels.keep.erase(v);
  const Space space = make_space(voxels);
  const int first = space.octree.find({0, 0, 7}), second = space.octree.find({1, 0, 7});
  std::vector<int> tried;
  bool second_gone = false;
  const auto robot = [&](int block, int) -> BlockTrial {
    tried.push_back(block);
    if (block == first && !second_gone) return {0, 1, {0, 0, 7}};
    second_gone = second_gone || block == second;
    return {1, 0, {0, 0, 7}};
  };
  order_blocks(space.octree, space.graph, {0, 0, 7}, 0, robot, {});
  EXPECT_EQ(tried, (std::vector<int>{first, second, first}));
}

TEST(BlockOrder, WhatNeverWorksIsTriedAtEveryEffortAndThenLeft) {
  VoxelGrid voxels{VoxelSet(8, true), VoxelSet(8, true)};
  voxels.keep.erase({3, 3, 7});
  const Space space = make_space(voxels);
  std::vector<int> efforts;
  const auto robot = [&](int, int effort) -> BlockTrial {
    efforts.push_back(effort);
    return {0, 1, {3, 3, 7}};
  };
  order_blocks(space.octree, space.graph, {0, 0, 7}, 2, robot, {});
  EXPECT_EQ(efforts, (std::vector<int>{0, 1, 2}));
}

TEST(BlockOrder, APartlyRemovedBlockKeepsItsRestForLater) {
  VoxelGrid voxels{VoxelSet(8, true), VoxelSet(8)};
  const Space space = make_space(voxels);
  ASSERT_EQ(space.octree.leaves.size(), 1u);
  int left = 512, calls = 0;
  const auto robot = [&](int, int) -> BlockTrial {
    ++calls;
    const int now = std::min(left, 200);
    left -= now;
    return {now, left, {}};
  };
  order_blocks(space.octree, space.graph, {0, 0, 7}, 0, robot, {});
  EXPECT_EQ(left, 0);
  EXPECT_EQ(calls, 3);
}

TEST(BlockOrder, StopsWhenAsked) {
  const VoxelGrid voxels = random_grid(16, 1);
  const Space space = make_space(voxels);
  std::stop_source stop;
  int calls = 0;
  const auto robot = [&](int block, int) -> BlockTrial {
    if (++calls == 3) stop.request_stop();
    const Block& b = space.octree.leaves[static_cast<std::size_t>(block)];
    return {volume(b), 0, b.corner};
  };
  EXPECT_THROW(order_blocks(space.octree, space.graph, {0, 0, 15}, 0, robot, {stop.get_token(), {}}), Cancelled);
  EXPECT_EQ(calls, 3);
}

}  // namespace
TEST(BlockOrder, ForeseesWhatIsTriedNextWhileNothingIsRemoved) {
  Random random(11);
  const VoxelGrid voxels = random_grid(16, 2);
  const Space space = make_space(voxels);
  std::vector<int> foreseen;  // the best last
  std::size_t most_foreseen = 0;
  const auto robot = [&](int block, int) -> BlockTrial {
    if (!foreseen.empty()) {
      EXPECT_EQ(block, foreseen.back());
      foreseen.pop_back();
    }
    const int size = space.octree.leaves[static_cast<std::size_t>(block)].size;
    if (random.next() % 20 > 0) return {0, size * size * size, {0, 0, 15}};
    foreseen.clear();
    return {size * size * size, 0, {0, 0, 15}};
  };
  const auto foresee = [&](std::span<const int> blocks, int) {
    EXPECT_TRUE(foreseen.empty());
    foreseen.assign(blocks.begin(), blocks.end());
    most_foreseen = std::max(most_foreseen, blocks.size());
  };
  order_blocks(space.octree, space.graph, {0, 0, 15}, 2, robot, {}, foresee);
  EXPECT_GT(most_foreseen, 8u);
}

}  // namespace sculpt
