#include "core/material/clamping.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/material/shapes.hpp"

namespace sculpt {
namespace {

constexpr int n = 8;
const CubeTurn over = cube_turn(Vec3(std::numbers::pi, 0, 0)).value();

VoxelSet set_of(std::initializer_list<Voxel> voxels) {
  VoxelSet set(n);
  for (const Voxel v : voxels) set.insert(v);
  return set;
}

TEST(Clamping, WhatIsLeftStandsOnItsHeadOnTheFloor) {
  const VoxelSet target = set_of({{2, 1, 0}, {2, 1, 1}}), left = set_of({{2, 1, 0}, {2, 1, 1}, {3, 1, 2}});
  const VoxelGrid next = clamp_anew({VoxelSet(n, true), target}, left, over);
  EXPECT_EQ(next.stock, set_of({{2, 6, 2}, {2, 6, 1}, {3, 6, 0}}));
  EXPECT_EQ(next.keep, set_of({{2, 6, 2}, {2, 6, 1}}));
}

TEST(Clamping, NothingMovesWithoutATurnOfWhatStandsOnTheFloor) {
  const VoxelGrid before = shapes::random_grid(n, 3);
  const VoxelGrid next = clamp_anew(before, before.stock, no_turn);
  EXPECT_EQ(next.stock, before.stock);
  EXPECT_EQ(next.keep, before.keep);
}

TEST(Clamping, ATargetThatIsNotInWhatIsLeftIsRefused) {
  const VoxelSet target = set_of({{2, 1, 0}, {2, 1, 1}}), left = set_of({{2, 1, 0}});
  const auto work = [&] { clamp_anew({VoxelSet(n, true), target}, left, over); };
  EXPECT_EQ(shapes::error_code(work), "target_outside_stock");
  EXPECT_NE(shapes::error_sentence(work).find("1 of 2 voxels"), std::string::npos) << shapes::error_sentence(work);
  EXPECT_NE(shapes::error_sentence(work).find("2, 1, 1"), std::string::npos) << shapes::error_sentence(work);
}

TEST(Clamping, WhatIsAmbiguousGoesWithTheTarget) {
  const VoxelSet target = set_of({{2, 1, 1}, {4, 3, 6}});
  const VoxelGrid next = clamp_anew({VoxelSet(n, true), target, {2, {2, 1, 1}, {4, 3, 6}}}, target, over);
  EXPECT_EQ(next.keep, set_of({{2, 6, 5}, {4, 4, 0}}));
  EXPECT_EQ(next.ambiguous.voxels, 2u);
  EXPECT_EQ(next.ambiguous.low, (Voxel{2, 4, 0}));
  EXPECT_EQ(next.ambiguous.high, (Voxel{4, 6, 5}));
}

}  // namespace
}  // namespace sculpt
