#include "core/material/loose_pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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

/// Breadth-first from the voxels of layer 0, voxel by voxel.
VoxelSet loose_by_brute_force(const VoxelSet& standing) {
  const Grid bounds{standing.n(), 1, Vec3::Zero()};
  VoxelSet loose = standing;
  std::vector<Voxel> queue;
  for (Voxel voxel : members(standing))
    if (voxel.k == 0) queue.push_back(voxel);
  for (Voxel voxel : queue) loose.erase(voxel);
  for (std::size_t at = 0; at < queue.size(); ++at)
    for (Voxel step : face_steps) {
      const Voxel next = queue[at] + step;
      if (!bounds.contains(next) || !loose.contains(next)) continue;
      loose.erase(next);
      queue.push_back(next);
    }
  return loose;
}

std::vector<Voxel> voxels_of(const VoxelLine& line) {
  std::vector<Voxel> all{line.first};
  const auto sign = [](int value) { return (value > 0) - (value < 0); };
  const Voxel way = line.last - line.first;
  while (all.back() != line.last) all.push_back(all.back() + Voxel{sign(way.i), sign(way.j), sign(way.k)});
  return all;
}

/// Flood fill after every single voxel.
LoosePieces watch_by_brute_force(const VoxelSet& stock, const std::vector<VoxelLine>& lines) {
  VoxelSet standing = stock, loose = loose_by_brute_force(stock);
  LoosePieces pieces{loose.size(), loose.size(), {}};
  for (std::size_t number = 0; number < lines.size(); ++number)
    for (Voxel voxel : voxels_of(lines[number])) {
      standing.erase(voxel);
      const VoxelSet after = loose_by_brute_force(standing);
      std::uint64_t freed = 0;
      for (Voxel each : members(after)) freed += !loose.contains(each);
      if (freed > 0) pieces.loosenings.push_back({number, voxel, freed, freed});
      pieces.most = std::max<std::uint64_t>(pieces.most, after.size());
      loose = after;
    }
  return pieces;
}

/// Removes what is not keep, in random lines in random order; leaves a little.
std::vector<VoxelLine> random_lines(const VoxelGrid& grid, Random& random) {
  VoxelSet waiting = grid.stock;
  std::vector<Voxel> order;
  for (Voxel voxel : members(grid.stock)) {
    if (grid.label(voxel) == Label::remove && random.unit() < 0.98)
      order.push_back(voxel);
    else
      waiting.erase(voxel);
  }
  // From the top down in one half of the cases: in a random order nearly everything hangs on nothing for a while.
  const bool from_top = random.unit() < 0.5;
  for (std::size_t at = order.size(); at > 1; --at) std::swap(order[at - 1], order[random.next() % at]);
  if (from_top) std::stable_sort(order.begin(), order.end(), [](Voxel a, Voxel b) { return a.k > b.k; });
  std::vector<VoxelLine> lines;
  for (Voxel first : order) {
    if (!waiting.contains(first)) continue;
    const Voxel step = face_steps[random.next() % (from_top ? 4 : 6)];
    Voxel last = first;
    waiting.erase(first);
    for (Voxel next = first + step;
         Grid{grid.n(), 1, Vec3::Zero()}.contains(next) && waiting.contains(next) && random.unit() < 0.8;
         next = next + step) {
      waiting.erase(next);
      last = next;
    }
    lines.push_back({first, last});
  }
  return lines;
}

TEST(LoosePieces, AreThoseOfAPlainFloodAfterEveryVoxelWhateverTheOrder) {
  int quiet = 0, freeing = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const VoxelGrid grid = shapes::random_grid(seed % 4 == 3 ? 8 : 4, seed);
    const std::vector<VoxelLine> lines = random_lines(grid, random);
    const LoosePieces expected = watch_by_brute_force(grid.stock, lines);
    const LoosePieces found = find_loose_pieces(grid.stock, lines);
    EXPECT_EQ(found.at_start, expected.at_start);
    EXPECT_EQ(found.most, expected.most);
    ASSERT_EQ(found.loosenings.size(), expected.loosenings.size());
    for (std::size_t at = 0; at < expected.loosenings.size(); ++at) {
      EXPECT_EQ(found.loosenings[at].line, expected.loosenings[at].line);
      EXPECT_EQ(found.loosenings[at].removed, expected.loosenings[at].removed);
      EXPECT_EQ(found.loosenings[at].freed, expected.loosenings[at].freed);
    }
    (expected.loosenings.empty() ? quiet : freeing) += 1;
  }
  EXPECT_GT(quiet, 10);
  EXPECT_GT(freeing, 40);
}

TEST(LoosePieces, LooseIsWhatNoPathJoinsToTheFloor) {
  int with_loose = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelSet keep = shapes::random_grid(8 << seed % 3, seed).keep;
    const VoxelSet loose = loose_by_brute_force(keep);
    ASSERT_EQ(find_loose(keep), loose);
    with_loose += loose.size() > 0;
  }
  EXPECT_GT(with_loose, 20);
}

VoxelSet all_of(int n, std::initializer_list<VoxelLine> lines) {
  VoxelSet set(n);
  for (const VoxelLine& line : lines)
    for (Voxel voxel : voxels_of(line)) set.insert(voxel);
  return set;
}

TEST(LoosePieces, PiecesThatMeetAtAnEdgeAreTwo) {
  EXPECT_EQ(count_pieces(VoxelSet(8)), 0u);
  EXPECT_EQ(count_pieces(VoxelSet(128, true)), 1u);
  EXPECT_EQ(count_pieces(all_of(8, {{{0, 0, 0}, {3, 0, 0}}, {{4, 1, 0}, {7, 1, 0}}, {{7, 7, 7}, {7, 7, 7}}})), 3u);
  EXPECT_EQ(find_loose(all_of(8, {{{3, 3, 0}, {3, 3, 2}}, {{3, 4, 3}, {3, 4, 5}}})).size(), 3u);
}

/// A post with a bar on top that reaches out from it.
const VoxelLine post{{2, 2, 0}, {2, 2, 4}}, bar{{3, 2, 4}, {7, 2, 4}};

TEST(LoosePieces, ABarMayBeCutFromItsTipButNotFromItsRoot) {
  const VoxelSet gallows = all_of(8, {post, bar});
  const LoosePieces from_tip = find_loose_pieces(gallows, {{bar.last, bar.first}});
  EXPECT_TRUE(from_tip.loosenings.empty());
  EXPECT_EQ(from_tip.most, 0u);
  const LoosePieces from_root = find_loose_pieces(gallows, {bar});
  ASSERT_EQ(from_root.loosenings.size(), 1u) << "the rest of the very line that is being cut";
  EXPECT_EQ(from_root.loosenings[0].removed, bar.first);
  EXPECT_EQ(from_root.loosenings[0].freed, 4u);
  EXPECT_EQ(from_root.most, 4u);
}

TEST(LoosePieces, TheLineThatCutsAPieceOffIsNamedWhetherThePieceIsKeptOrCutLater) {
  const VoxelSet gallows = all_of(8, {post, bar});
  const VoxelLine tip{{7, 2, 4}, {7, 2, 4}}, foot{{2, 2, 1}, {2, 2, 1}};
  const LoosePieces kept = find_loose_pieces(gallows, {tip, foot});
  ASSERT_EQ(kept.loosenings.size(), 1u);
  EXPECT_EQ(kept.loosenings[0].line, 1u);
  EXPECT_EQ(kept.loosenings[0].freed, 7u);
  const LoosePieces later = find_loose_pieces(gallows, {foot, tip, {{6, 2, 4}, {3, 2, 4}}, {{2, 2, 4}, {2, 2, 2}}});
  ASSERT_EQ(later.loosenings.size(), 1u);
  EXPECT_EQ(later.loosenings[0].line, 0u);
  EXPECT_EQ(later.most, 8u);
}

TEST(LoosePieces, AStockThatHangsOnNothingIsReportedWithoutAnyRemoval) {
  const LoosePieces pieces = find_loose_pieces(all_of(8, {bar}), {});
  EXPECT_EQ(pieces.at_start, 5u);
  EXPECT_EQ(pieces.most, 5u);
  EXPECT_TRUE(pieces.loosenings.empty());
}

}  // namespace
}  // namespace sculpt
