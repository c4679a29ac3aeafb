// What comes loose when a cut takes many voxels at once, against a flood after every cut.
#include "core/verify/mill/cutter_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/base/random.hpp"
#include "core/verify/material/held_voxels.hpp"
#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

constexpr double voxel_mm = 2;

/// Its chips hold up to 1.1 x 1.1 x 1.1 mm: of voxels of 2 mm that may be three, as a grid may lie.
MillTool fine_tool() {
  MillTool tool;
  tool.max_depth_m = tool.max_width_m = 1e-3;
  return tool;
}
constexpr std::uint64_t chip = 3;

struct Cut {
  std::vector<Voxel> voxels;
  std::vector<std::uint64_t> freed;  ///< voxels of each piece that is larger than a chip, not said to fall
};

std::vector<Cut> random_cuts(VoxelSet& standing, const VoxelSet& may_fall, Random& random) {
  std::vector<Cut> cuts;
  VoxelSet loose = shapes::loose_by_brute_force(standing);
  for (int count = 0; count < 12; ++count) {
    Cut cut{shapes::random_box_of(standing, random), {}};
    for (const Voxel v : cut.voxels) standing.erase(v);
    VoxelSet fresh = shapes::loose_by_brute_force(standing);
    const VoxelSet after = fresh;
    fresh -= loose;
    loose = after;
    for (const std::vector<Voxel>& piece : shapes::pieces_of(fresh)) {
      const auto voxels =
          static_cast<std::uint64_t>(std::ranges::count_if(piece, [&](Voxel v) { return !may_fall.contains(v); }));
      if (voxels > chip) cut.freed.push_back(voxels);
    }
    cuts.push_back(std::move(cut));
  }
  return cuts;
}

TEST(CutterLog, FindsThePiecesThatAFloodAfterEveryCutFinds) {
  int freeing = 0, several = 0, quiet = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const VoxelGrid grid = shapes::crumbled(shapes::random_grid(seed % 4 == 3 ? 16 : 8, seed), random);
    const VoxelSet may_fall = find_never_held(grid);
    VoxelSet left = grid.stock;
    const std::vector<Cut> cuts = random_cuts(left, may_fall, random);
    CutterLog log(grid.n(), voxel_mm);
    for (std::size_t line = 0; line < cuts.size(); ++line) log.add(line, fine_tool(), cuts[line].voxels);
    const std::vector<FreedChunk> found = log.find_freed(left, may_fall, [] {});
    std::size_t at = 0;
    for (std::size_t line = 0; line < cuts.size(); ++line) {
      std::multiset<std::uint64_t> expected(cuts[line].freed.begin(), cuts[line].freed.end()), freed;
      for (; at < found.size() && found[at].line == line; ++at) freed.insert(found[at].voxels);
      EXPECT_EQ(freed, expected) << "cut " << line;
      several += expected.size() > 1;
    }
    EXPECT_EQ(at, found.size());
    (found.empty() ? quiet : freeing) += 1;
  }
  EXPECT_GT(freeing, 100);
  EXPECT_GT(several, 20);
  EXPECT_GT(quiet, 20);
}

TEST(CutterLog, AStopIsHeard) {
  CutterLog log(8, voxel_mm);
  const Voxel voxel{1, 1, 1};
  log.add(2, fine_tool(), {&voxel, 1});
  struct Stopped {};
  EXPECT_THROW(log.find_freed(VoxelSet(8), VoxelSet(8), [] { throw Stopped{}; }), Stopped);
}

}  // namespace
}  // namespace sculpt
