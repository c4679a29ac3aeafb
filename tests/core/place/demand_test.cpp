#include "core/place/demand.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/base/random.hpp"
#include "core/place/turn_over.hpp"

namespace sculpt {
namespace {

constexpr int n = 16;

const Helpers one_thread(1);
const Watch nobody;
const RunContext run{0, one_thread, nobody};

ArmReach reach_of(Hold hold) {
  ArmReach reach;
  for (auto& view : reach.holds) view.fill(hold);
  return reach;
}

std::uint64_t sum(const Share& share) {
  return share.held + share.tool + share.stock + share.links + share.limits + share.reach;
}

/// A table: four legs and a top, so that what is under it is open to the sides only.
VoxelGrid table() {
  VoxelGrid voxels{VoxelSet(n, true), VoxelSet(n), {}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (k >= n - 2 || ((i < 2 || i >= n - 2) && (j < 2 || j >= n - 2))) voxels.keep.insert({i, j, k});
  return voxels;
}

TEST(Demand, AnArmThatHoldsEverythingReachesAllThatTheToolDoes) {
  const VoxelGrid voxels = table();
  const Demand demand = find_demand(voxels, {no_turn}, Access::along_views, run);
  EXPECT_EQ(demand.removable, voxels.stock.size() - voxels.keep.size());
  const ArmReach reach = reach_of(Hold::held);
  const Share share = find_share(demand, {&reach});
  EXPECT_EQ(share.held, demand.removable);  // from the sides
  EXPECT_EQ(share.held_along[0], 0u);       // the top is in the way
}

TEST(Demand, EveryVoxelHasOneReason) {
  Random random(7);
  const Demand demand = find_demand(table(), {no_turn}, Access::along_views, run);
  for (int round = 0; round < 50; ++round) {
    ArmReach reach;
    for (auto& view : reach.holds)
      for (Hold& hold : view) hold = static_cast<Hold>(random.next() % 5);
    const Share share = find_share(demand, {&reach});
    ASSERT_EQ(sum(share), share.removable);
    for (const std::uint64_t along : share.held_along) ASSERT_LE(along, share.held);
  }
}

TEST(Demand, WhatOnlyOneDirectionAsksForIsLostWithIt) {
  // A pit that goes down from the top, as narrow as a voxel.
  VoxelGrid voxels{VoxelSet(n, true), VoxelSet(n, true), {}};
  for (int k = 4; k < n; ++k) voxels.keep.erase({8, 8, k});
  const Demand demand = find_demand(voxels, {no_turn}, Access::along_views, run);
  ArmReach reach = reach_of(Hold::held);
  reach.holds[0].fill(Hold::limits);
  const Share share = find_share(demand, {&reach});
  EXPECT_EQ(share.removable, static_cast<std::uint64_t>(n - 4));
  EXPECT_EQ(share.held, 0u);
  EXPECT_EQ(share.limits, share.removable);
}

TEST(Demand, ATurnedBlockAsksForTheSameFromTheOtherSide) {
  // Open downwards only: a pit from below.
  VoxelGrid voxels{VoxelSet(n, true), VoxelSet(n, true), {}};
  for (int k = 0; k < n - 4; ++k) voxels.keep.erase({3, 8, k});
  const ArmReach reach = reach_of(Hold::held);
  const Share once = find_share(find_demand(voxels, {no_turn}, Access::along_views, run), {&reach});
  EXPECT_GT(once.tool, 0u);
  const std::vector<TurnOver> turns = rate_turn_overs(voxels, Access::along_views, reach, run);
  ASSERT_EQ(turns.size(), 5u);
  EXPECT_EQ(turns.front().share.held, once.removable);
  EXPECT_EQ(turns.front().name, "half a turn about x");
  for (const TurnOver& turn : turns) {
    EXPECT_EQ(sum(turn.share), turn.share.removable);
    EXPECT_GE(turn.share.held, once.held);
  }
}

}  // namespace
}  // namespace sculpt
