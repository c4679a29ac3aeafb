// What comes loose, against a flood after every single voxel.
#include "core/verify/material/held_voxels.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"
#include "core/material/loose_pieces.hpp"
#include "core/verify/material/cut_log.hpp"
#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

std::vector<Voxel> members(const VoxelSet& set) {
  std::vector<Voxel> all;
  for_each_voxel(set, [&](Voxel voxel) { all.push_back(voxel); });
  return all;
}

bool is_inside(int n, Voxel v) {
  return Grid{n, 1, Vec3::Zero()}.contains(v);
}

Keyframe cut(Voxel first, Voxel last) {
  return {{}, true, first, last};
}

std::vector<Voxel> voxels_of(const Keyframe& line) {
  return shapes::row_of(line.first, line.last);
}

/// What is not keep, in random lines: in random order, where nearly everything hangs on nothing for a while, or from
/// the top down. A little is left.
std::vector<Keyframe> random_cuts(const VoxelGrid& grid, Random& random) {
  VoxelSet waiting = grid.stock;
  std::vector<Voxel> order;
  for (Voxel voxel : members(grid.stock)) {
    if (grid.label(voxel) == Label::remove && random.unit() < 0.98)
      order.push_back(voxel);
    else
      waiting.erase(voxel);
  }
  const bool from_top = random.unit() < 0.5;
  for (std::size_t at = order.size(); at > 1; --at) std::swap(order[at - 1], order[random.next() % at]);
  if (from_top) std::stable_sort(order.begin(), order.end(), [](Voxel a, Voxel b) { return a.k > b.k; });
  std::vector<Keyframe> cuts;
  for (Voxel first : order) {
    if (!waiting.contains(first)) continue;
    const Voxel step = face_steps[random.next() % (from_top ? 4 : 6)];
    Voxel last = first;
    waiting.erase(first);
    for (Voxel next = first + step; is_inside(grid.n(), next) && waiting.contains(next) && random.unit() < 0.8;
         next = next + step) {
      waiting.erase(next);
      last = next;
    }
    cuts.push_back(cut(first, last));
  }
  return cuts;
}

std::vector<FreedPiece> freed_by(const VoxelSet& stock, const std::vector<Keyframe>& cuts, const VoxelSet& may_fall) {
  CutLog log(stock.n());
  for (std::size_t line = 0; line < cuts.size(); ++line) log.add(cuts[line], line);
  return log.find_freed(stock, may_fall, [] {});
}

TEST(HeldVoxels, WhatACutFreesIsWhatAFloodAfterEveryVoxelSays) {
  int quiet = 0, freeing = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const VoxelGrid grid = shapes::random_grid(seed % 4 == 3 ? 8 : 4, seed);
    const std::vector<Keyframe> cuts = random_cuts(grid, random);
    const VoxelSet may_fall = find_never_held(grid);
    const std::vector<FreedPiece> found = freed_by(grid.stock, cuts, may_fall);
    std::size_t at = 0;
    VoxelSet standing = grid.stock, loose = shapes::loose_by_brute_force(standing);
    for (std::size_t line = 0; line < cuts.size(); ++line)
      for (Voxel voxel : voxels_of(cuts[line])) {
        standing.erase(voxel);
        const VoxelSet after = shapes::loose_by_brute_force(standing);
        std::uint64_t freed = 0, unforeseen = 0;
        for (Voxel each : members(after)) {
          if (loose.contains(each)) continue;
          ++freed;
          unforeseen += !may_fall.contains(each);
        }
        loose = after;
        if (freed == 0) continue;
        ASSERT_LT(at, found.size());
        EXPECT_EQ(found[at].line, line);
        EXPECT_EQ(found[at].removed, voxel);
        EXPECT_EQ(found[at].voxels, freed);
        EXPECT_EQ(found[at++].unforeseen, unforeseen);
      }
    EXPECT_EQ(at, found.size());
    (found.empty() ? quiet : freeing) += 1;
  }
  EXPECT_GT(quiet, 10);
  EXPECT_GT(freeing, 40);
}

TEST(HeldVoxels, WhatIsNeverHeldIsWhatThePlannerSaysToo) {
  int some = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid grid = shapes::random_grid(4 << seed % 3, seed);
    const VoxelSet found = find_never_held(grid);
    ASSERT_EQ(found, find_unheld(grid));
    some += found.size() > 0;
  }
  EXPECT_GT(some, 20);
}

/// A post with a bar on top that reaches out from it.
const Keyframe post = cut({2, 2, 0}, {2, 2, 4}), bar = cut({3, 2, 4}, {7, 2, 4});

VoxelSet gallows() {
  VoxelSet set(8);
  for (const Keyframe& line : {post, bar})
    for (Voxel voxel : voxels_of(line)) set.insert(voxel);
  return set;
}

TEST(HeldVoxels, ABarMayBeCutFromItsTipButNotFromItsRoot) {
  EXPECT_TRUE(freed_by(gallows(), {cut(bar.last, bar.first)}, VoxelSet(8)).empty());
  const std::vector<FreedPiece> from_root = freed_by(gallows(), {bar}, VoxelSet(8));
  ASSERT_EQ(from_root.size(), 1u) << "the rest of the very line that is being cut";
  EXPECT_EQ(from_root[0].removed, bar.first);
  EXPECT_EQ(from_root[0].voxels, 4u);
}

TEST(HeldVoxels, TheLineThatCutsAPieceOffIsNamedWhetherThePieceIsKeptOrCutLater) {
  const Keyframe tip = cut({7, 2, 4}, {7, 2, 4}), foot = cut({2, 2, 1}, {2, 2, 1});
  const std::vector<FreedPiece> kept = freed_by(gallows(), {tip, foot}, VoxelSet(8));
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].line, 1u);
  EXPECT_EQ(kept[0].voxels, 7u);
  const std::vector<FreedPiece> later =
      freed_by(gallows(), {foot, tip, cut({6, 2, 4}, {3, 2, 4}), cut({2, 2, 4}, {2, 2, 2})}, VoxelSet(8));
  ASSERT_EQ(later.size(), 1u);
  EXPECT_EQ(later[0].line, 0u);
}

TEST(HeldVoxels, StockThatHangsOnNothingIsNotFreed) {
  VoxelSet floating = gallows();
  floating.erase(post.first, post.last);
  EXPECT_TRUE(freed_by(floating, {cut(bar.first, bar.first)}, VoxelSet(8)).empty());
}

}  // namespace
}  // namespace sculpt
