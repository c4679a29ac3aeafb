// Which cuts bring a piece loose, against a flood of all that stands before and after each of them.
#include "core/mill/piece_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"
#include "core/material/loose_pieces.hpp"
#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

SweptSet::Taken words_of(int n, const std::vector<Voxel>& voxels) {
  VoxelSet set(n);
  for (const Voxel v : voxels) set.insert(v);
  SweptSet::Taken taken;
  for (std::size_t word = 0; word < set.words().size(); ++word)
    if (set.words()[word] != 0) taken.emplace_back(word, set.words()[word]);
  return taken;
}

bool frees_by_brute_force(const VoxelSet& before, const VoxelSet& after, const VoxelSet& may_fall, double chip) {
  VoxelSet fresh = shapes::loose_by_brute_force(after);
  fresh -= shapes::loose_by_brute_force(before);
  return std::ranges::any_of(shapes::pieces_of(fresh), [&](const std::vector<Voxel>& piece) {
    return static_cast<double>(std::ranges::count_if(piece, [&](Voxel v) { return !may_fall.contains(v); })) > chip;
  });
}

TEST(PieceWatch, SaysWhatAFloodOfEverythingSays) {
  int held = 0, freed = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int n = seed % 3 == 2 ? 16 : 8;
    const VoxelGrid grid = shapes::crumbled(shapes::random_grid(n, seed), random);
    const VoxelSet may_fall = find_unheld(grid);
    const auto chip = static_cast<double>(random.between(0, 6));
    PieceWatch watch(grid);
    VoxelSet standing = grid.stock;
    for (int count = 0; count < 20; ++count) {
      const std::vector<Voxel> cut = shapes::random_box_of(standing, random);
      VoxelSet after = standing;
      for (const Voxel v : cut) after.erase(v);
      const bool frees = frees_by_brute_force(standing, after, may_fall, chip);
      ASSERT_EQ(watch.frees(after, words_of(n, cut), chip), frees) << "cut " << count;
      // As the planner does: what would bring a piece loose stays.
      if (!frees) standing = after;
      (frees ? freed : held) += 1;
    }
  }
  EXPECT_GT(held, 1000);
  EXPECT_GT(freed, 500);
}

}  // namespace
}  // namespace sculpt
