// What the searches of the translating robot do where pieces must not come free, and where they cannot go.
#include "core/search/ground.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/base/random.hpp"
#include "core/search/voxel_search.hpp"
#include "tests/core/material/shapes.hpp"
#include "tests/core/search/replay.hpp"

namespace sculpt {
namespace {

/// Mushroom; bridge; a roof on four posts; a block in the air; the same around a hollow that is open below.
VoxelSet overhang(int n, int number) {
  VoxelSet target(n);
  const int q = n / 4, half = n / 2, last = n - 1;
  switch (number) {
    case 0:
      shapes::fill(target, {half, half, 0}, {half, half, half});
      shapes::fill(target, {1, 1, half}, {last - 1, last - 1, half + q});
      break;
    case 1:
      shapes::fill(target, {0, q, 0}, {1, half, half});
      shapes::fill(target, {last - 1, q, 0}, {last, half, half});
      shapes::fill(target, {0, q, half}, {last, half, half + 1});
      break;
    case 2:
      shapes::fill(target, {0, 0, half}, {last, last, half});
      for (int corner = 0; corner < 4; ++corner) {
        const Voxel foot{corner & 1 ? last : 0, corner & 2 ? last : 0, 0};
        shapes::fill(target, foot, foot + Voxel{0, 0, half});
      }
      break;
    default:
      shapes::fill(target, {q, q, half}, {last - q, last - q, half + q});
      if (number > 3)
        for (int k = half; k < half + q; ++k)
          for (int j = q + 1; j < last - q; ++j)
            for (int i = q + 1; i < last - q; ++i) target.erase({i, j, k});
  }
  return target;
}

using Search = std::vector<VoxelRun> (*)(const VoxelGrid&, const Ground&);

std::vector<VoxelRun> by_voxels(const VoxelGrid& voxels, const Ground& ground) {
  std::vector<VoxelRun> runs;
  carve_voxelwise(voxels, ground, [&](const VoxelRun& run) { runs.push_back(run); }, {});
  return runs;
}

std::vector<VoxelRun> by_blocks(const VoxelGrid& voxels, const Ground& ground) {
  std::vector<VoxelRun> runs;
  const Octree octree = build_octree(voxels, {});
  carve_translating(voxels, octree, build_block_graph(octree, {}), ground,
                    [&](const VoxelRun& run) { runs.push_back(run); }, {});
  return runs;
}

/// Of the set, what no path over faces joins to the lowest layer.
VoxelSet hangs_on_nothing(const VoxelSet& set) {
  VoxelSet hanging = set;
  std::vector<Voxel> open;
  const auto hold = [&](Voxel v) {
    const bool inside = v.i >= 0 && v.j >= 0 && v.k >= 0 && v.i < set.n() && v.j < set.n() && v.k < set.n();
    if (!inside || !hanging.contains(v)) return;
    hanging.erase(v);
    open.push_back(v);
  };
  for (int j = 0; j < set.n(); ++j)
    for (int i = 0; i < set.n(); ++i) hold({i, j, 0});
  while (!open.empty()) {
    const Voxel v = open.back();
    open.pop_back();
    for (const Voxel side : {Voxel{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) hold(v + side);
  }
  return hanging;
}

/// No cut frees what may not fall; of what is left each voxel would, or lies behind such a one. Gives what is left.
VoxelSet expect_held(Search search, const VoxelGrid& voxels) {
  const VoxelSet may_fall = find_unheld(voxels);
  const Support support(voxels.stock, may_fall);
  const Voxel entry = translating_entry(voxels.n());
  const auto runs = search(voxels, {entry, entry, {}, {}, &support});
  const Replayed done = replay(voxels, runs);
  EXPECT_EQ(done.fault, "");
  VoxelSet now = voxels.stock;
  const VoxelSet never_held = hangs_on_nothing(now);
  const std::size_t stride = voxels.n() > 8 ? 16 : 1;  // a flood each is what takes time
  for (std::size_t at = 0; at < runs.size(); ++at) {
    const VoxelRun& run = runs[at];
    if (run.cut) now.erase(run.first, run.last);
    if (at % stride != 0 && at + 1 != runs.size()) continue;
    VoxelSet hanging = hangs_on_nothing(now);
    hanging -= may_fall;
    hanging -= never_held;
    EXPECT_EQ(hanging.size(), 0u) << "after the run from " << run.first.i << " " << run.first.j << " " << run.first.k;
  }

  VoxelSet standing = voxels.stock, left = voxels.stock;
  standing -= done.removed;
  left -= done.removed;
  left -= voxels.keep;
  left -= enclosed_by_flood(voxels);
  const Support in_the_end(standing, may_fall);
  const VoxelGrid all_that_frees{standing, [&] {
                                   VoxelSet keep = voxels.keep;
                                   for_each_voxel(left, [&](Voxel v) {
                                     if (in_the_end.frees(v)) keep.insert(v);
                                   });
                                   return keep;
                                 }()};
  VoxelSet open = left;
  open -= all_that_frees.keep;
  open -= enclosed_by_flood(all_that_frees);
  EXPECT_EQ(open.size(), 0u) << "could have been cut";
  return left;
}

TEST(Ground, NoSearchFreesWhatIsToBeHeld) {
  for (const Search search : {by_voxels, by_blocks})
    for (int n : {8, 16})
      for (int number = 0; number < 5; ++number) {
        SCOPED_TRACE("shape " + std::to_string(number) + " at " + std::to_string(n));
        EXPECT_EQ(expect_held(search, {VoxelSet(n, true), overhang(n, number)}).size(), 0u);
      }
}

TEST(Ground, RandomShapesAreHeldToo) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid voxels = random_voxels(8 << seed % 2, seed);
    expect_held(by_voxels, voxels);
    expect_held(by_blocks, voxels);
    if (testing::Test::HasFailure()) break;
  }
}

TEST(Ground, WhereNothingHoldsAnythingTheRunsAreTheSame) {
  for (const Search search : {by_voxels, by_blocks}) {
    VoxelSet wall(16);
    shapes::fill(wall, {3, 5, 0}, {9, 6, 12});
    const VoxelGrid voxels{VoxelSet(16, true), wall};
    const VoxelSet may_fall(16);
    const Support support(voxels.stock, may_fall);
    const Voxel entry = translating_entry(16);
    const auto careless = search(voxels, {entry, entry}), careful = search(voxels, {entry, entry, {}, {}, &support});
    EXPECT_EQ(replay(voxels, careful).removed, replay(voxels, careless).removed);
  }
}

/// Steps of the runs, from and to.
std::set<std::pair<Voxel, Voxel>> steps_of(const std::vector<VoxelRun>& runs, Voxel at) {
  std::set<std::pair<Voxel, Voxel>> steps;
  const auto go = [&](Voxel to) {
    for (const Voxel step : face_steps)
      while (l1(at + step, to) < l1(at, to)) {
        steps.insert({at, at + step});
        at = at + step;
      }
  };
  for (const VoxelRun& run : runs) {
    go(run.first);
    go(run.last);
  }
  return steps;
}

TEST(Ground, NoSearchGoesWhereItIsClosedOrBlocked) {
  const int n = 8;
  for (const Search search : {by_voxels, by_blocks})
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(seed);
      const Voxel entry = translating_entry(n);
      Ground ground{entry, entry};
      for (int number = 0; number < 40; ++number) {
        const auto any = [&] { return static_cast<int>(random.next() % (n + 2)) - 1; };
        const Voxel beside{-1, any(), std::max(0, any())}, from{any(), any(), std::max(0, any())};
        ground.closed.push_back(beside);
        ground.blocked.emplace_back(from, from + face_steps[random.next() % 6]);
      }
      const VoxelGrid voxels = random_voxels(n, seed);
      const auto runs = search(voxels, ground);
      ASSERT_EQ(replay(voxels, runs).fault, "");
      const auto steps = steps_of(runs, entry);
      for (const Voxel closed : ground.closed)
        for (const auto& [from, to] : steps) ASSERT_NE(to, closed);
      for (const auto& [from, to] : ground.blocked) {
        ASSERT_FALSE(steps.contains({from, to}));
        ASSERT_FALSE(steps.contains({to, from}));
      }
    }
}

TEST(Ground, WhatIsBehindAClosedRingIsLeft) {
  // Three layers of stock, and a room that lets the robot in at one corner only.
  const int n = 8;
  VoxelGrid voxels{VoxelSet(n), VoxelSet(n)};
  shapes::fill(voxels.stock, {0, 0, 0}, {n - 1, n - 1, 2});
  for (int j = 0; j < n; ++j)
    for (int k = 0; k < n; ++k) {  // a wall across
      voxels.stock.insert({4, j, k});
      voxels.keep.insert({4, j, k});
    }
  Ground ground{translating_entry(n), translating_entry(n)};
  for (int at = -1; at <= n; ++at)
    for (int k = 0; k <= n; ++k) {
      ground.closed.push_back({4, -1, k});
      ground.closed.push_back({4, n, k});
      ground.closed.push_back({4, at, n});
    }
  for (const Search search : {by_voxels, by_blocks}) {
    const Replayed done = replay(voxels, search(voxels, ground));
    EXPECT_EQ(done.fault, "");
    EXPECT_EQ(done.removed.size(), 4u * n * 3) << "the near side";
  }
}

}  // namespace
}  // namespace sculpt
