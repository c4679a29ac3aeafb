#include "core/search/voxel_space.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <map>

#include "core/base/random.hpp"
#include "core/search/voxel_tree.hpp"
#include "tests/core/search/replay.hpp"

namespace sculpt {
namespace {

bool is_air(const VoxelGrid& voxels, Voxel v) {
  const int n = voxels.n();
  if (v.i < -1 || v.j < -1 || v.k < 0 || v.i > n || v.j > n || v.k > n) return false;
  return !Grid{n, 1, Vec3::Zero()}.contains(v) || voxels.label(v) == Label::air;
}

/// Steps through air to every voxel, by plain breadth-first search.
std::map<Voxel, int> steps_from(const VoxelGrid& voxels, Voxel start) {
  std::map<Voxel, int> steps{{start, 0}};
  std::deque<Voxel> queue{start};
  while (!queue.empty()) {
    const Voxel at = queue.front();
    queue.pop_front();
    for (Voxel step : face_steps)
      if (is_air(voxels, at + step) && steps.try_emplace(at + step, steps[at] + 1).second) queue.push_back(at + step);
  }
  return steps;
}

VoxelGrid with_air(Random& random) {
  VoxelGrid voxels{VoxelSet(8, true), VoxelSet(8)};
  const double share = random.unit();
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i)
        if (random.unit() < share) voxels.stock.erase({i, j, k});
  return voxels;
}

TEST(VoxelSpace, AVoxelIsAirOrRemoveAsTheGridSaysAndBesideAreItsNeighbours) {
  const VoxelGrid voxels = random_voxels(8, 3);
  VoxelSpace space(voxels);
  for (int k = 0; k <= 8; ++k)
    for (int j = -1; j <= 8; ++j)
      for (int i = -1; i <= 8; ++i) {
        const Voxel v{i, j, k};
        ASSERT_EQ(space.voxel(space.index(v)), v);
        ASSERT_EQ(space.is_air(space.index(v)), is_air(voxels, v));
        for (int face = 0; face < 6; ++face) {
          const VoxelSpace::Index beside = space.beside(space.index(v), face);
          ASSERT_EQ(space.voxel(beside), v + face_steps[face]);
          ASSERT_EQ(space.is_air(beside), is_air(voxels, v + face_steps[face]));
        }
      }
}

TEST(VoxelSpace, WaysToTheNearestOfASetAreFreeAndShortest) {
  int none = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const VoxelGrid voxels = with_air(random);
    VoxelSpace space(voxels);
    VoxelTree targets(8);
    const auto steps = steps_from(voxels, {-1, 3, 4});
    int least = 1 << 30;
    for (int target = 0; target < 4; ++target) {
      const auto number = [&] { return static_cast<int>(random.between(0, 8)); };
      const Voxel v{number(), number(), number()};
      if (is_air(voxels, v)) continue;
      targets.insert(v);
      for (const auto& [at, away] : steps)
        if (l1(at, v) == 1) least = std::min(least, away);
    }
    const auto way =
        space.find_way(space.index({-1, 3, 4}), 1, [&](Voxel from, int most) { return targets.distance(from, most); });
    none += !way;
    ASSERT_EQ(way.has_value(), least < 1 << 30);
    if (!way) continue;
    EXPECT_EQ(static_cast<int>(way->size()), least);
    Voxel at{-1, 3, 4};
    for (int face : *way) {
      at = at + face_steps[face];
      ASSERT_TRUE(is_air(voxels, at));
    }
    EXPECT_EQ(targets.distance(at, 100), 1);
  }
  EXPECT_GT(none, 5) << "no random set is out of reach any more";
}

}  // namespace
}  // namespace sculpt
