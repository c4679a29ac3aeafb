#include "core/material/cavities.hpp"

#include <gtest/gtest.h>

#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

/// Breadth-first, voxel by voxel, over a grid with a shell of outside at the sides and above.
VoxelSet enclosed_by_brute_force(const VoxelGrid& grid) {
  const int n = grid.n(), edge = n + 2;
  const Grid bounds{n, 1, Vec3::Zero()};
  const auto at = [edge](Voxel v) { return (v.i + 1) + edge * ((v.j + 1) + edge * v.k); };
  std::vector<bool> reached(static_cast<std::size_t>(edge) * edge * (n + 1));
  std::vector<Voxel> stack{{-1, -1, n}};
  reached[at(stack.back())] = true;
  while (!stack.empty()) {
    const Voxel here = stack.back();
    stack.pop_back();
    for (Voxel step : face_steps) {
      const Voxel next = here + step;
      if (next.i < -1 || next.j < -1 || next.k < 0 || next.i > n || next.j > n || next.k > n) continue;
      if (reached[at(next)] || (bounds.contains(next) && grid.label(next) == Label::keep)) continue;
      reached[at(next)] = true;
      stack.push_back(next);
    }
  }
  VoxelSet enclosed(n);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (grid.label({i, j, k}) == Label::remove && !reached[at({i, j, k})]) enclosed.insert({i, j, k});
  return enclosed;
}

TEST(Cavities, EnclosedVoxelsAreThoseOfAPlainFlood) {
  int with_cavity = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid grid = shapes::random_grid(8 << seed % 3, seed);
    const VoxelSet expected = enclosed_by_brute_force(grid);
    ASSERT_TRUE(find_enclosed(grid) == expected);
    with_cavity += expected.size() > 0;
  }
  EXPECT_GT(with_cavity, 20) << "the random grids no longer hold cavities, so this test says nothing";
}

TEST(Cavities, AMazeAcrossWordsIsFollowedToItsEnd) {
  VoxelGrid grid{VoxelSet(128, true), VoxelSet(128, true)};
  for (int j = 1; j < 127; j += 2) {
    for (int i = 1; i < 127; ++i) grid.keep.erase({i, j, 64});
    if (j < 125) grid.keep.erase({j % 4 == 1 ? 126 : 1, j + 1, 64});
  }
  EXPECT_TRUE(find_enclosed(grid) == enclosed_by_brute_force(grid));
  EXPECT_GT(find_enclosed(grid).size(), 1000u);
  grid.keep.erase({0, 1, 64});  // a door at the far end
  EXPECT_EQ(find_enclosed(grid).size(), 0u);
}

TEST(Cavities, TheFloorIsNoEntrance) {
  VoxelGrid grid{VoxelSet(8, true), VoxelSet(8, true)};
  grid.keep.erase({3, 3, 0});
  grid.keep.erase({3, 3, 1});
  EXPECT_EQ(find_enclosed(grid).size(), 2u);
  for (int k = 2; k < 8; ++k) grid.keep.erase({3, 3, k});
  EXPECT_EQ(find_enclosed(grid).size(), 0u);
}

TEST(Cavities, AirInsideIsNotListedButEnclosesNothingLess) {
  VoxelGrid grid{VoxelSet(8, true), VoxelSet(8, true)};
  grid.keep.erase({3, 3, 3});
  grid.keep.erase({4, 3, 3});
  grid.stock.erase({4, 3, 3});
  const VoxelSet enclosed = find_enclosed(grid);
  EXPECT_EQ(enclosed.size(), 1u);
  EXPECT_TRUE(enclosed.contains({3, 3, 3}));
}

}  // namespace
}  // namespace sculpt
