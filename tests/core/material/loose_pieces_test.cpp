#include "core/material/loose_pieces.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace sculpt
