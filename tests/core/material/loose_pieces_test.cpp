#include "core/material/loose_pieces.hpp"

#include <gtest/gtest.h>

#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

std::vector<Voxel> voxels_of(const VoxelLine& line) {
  return shapes::row_of(line.first, line.last);
}

TEST(LoosePieces, LooseIsWhatNoPathJoinsToTheFloor) {
  int with_loose = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelSet keep = shapes::random_grid(8 << seed % 3, seed).keep;
    const VoxelSet loose = shapes::loose_by_brute_force(keep);
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
