#include "core/search/open_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <map>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

/// Steps to every open voxel, by plain breadth-first search.
std::map<Voxel, int> steps_from(const OpenSpace& space, Voxel start) {
  std::map<Voxel, int> steps{{start, 0}};
  std::deque<Voxel> queue{start};
  while (!queue.empty()) {
    const Voxel at = queue.front();
    queue.pop_front();
    for (Voxel step : face_steps)
      if (space.is_open(at + step) && steps.try_emplace(at + step, steps[at] + 1).second) queue.push_back(at + step);
  }
  return steps;
}

/// Length of the way if every voxel of it is open, else -1.
int walk(const OpenSpace& space, Voxel at, const std::vector<Voxel>& way) {
  int length = 0;
  for (Voxel corner : way) {
    const int leg = l1(at, corner);
    if (leg == 0) return -1;
    const Voxel step{(corner.i - at.i) / leg, (corner.j - at.j) / leg, (corner.k - at.k) / leg};
    for (int s = 0; s < leg; ++s, ++length) {
      at = at + step;
      if (!space.is_open(at)) return -1;
    }
    if (at != corner) return -1;
  }
  return length;
}

TEST(OpenSpace, WaysAreOpenAndShortest) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    OpenSpace space(8);
    const double share = random.unit();
    for (int k = 0; k < 8; ++k)
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i)
          if (random.unit() < share) space.open({i, j, k});
    const auto place = [&] { return static_cast<int>(random.between(-1, 9)); };
    for (int query = 0; query < 40; ++query) {
      const Voxel from{place(), place(), std::max(place(), 0)}, to{place(), place(), std::max(place(), 0)};
      if (!space.is_open(from)) continue;
      const auto steps = steps_from(space, from);
      if (!steps.contains(to)) continue;
      const std::vector<Voxel> way = space.find_way(from, to).value();
      ASSERT_EQ(walk(space, from, way), steps.at(to));
      ASSERT_EQ(way.empty() ? from : way.back(), to);
    }
  }
}

TEST(OpenSpace, TheWantedVoxelFoundIsTheOneWithTheShortestWay) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    OpenSpace space(8);
    const double share = random.unit();
    std::vector<Voxel> wanted;
    for (int k = 0; k < 8; ++k)
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i) {
          if (random.unit() < 0.02) {
            space.want_cube({i, j, k}, 1);
            wanted.push_back({i, j, k});
          }
          if (random.unit() < share) space.open({i, j, k});
        }
    const Voxel from{-1, 3, static_cast<int>(random.between(0, 9))};
    int least = 1 << 30;
    for (const auto& [at, steps] : steps_from(space, from))
      for (Voxel v : wanted)
        if (l1(at, v) == 1 && !space.is_open(v)) least = std::min(least, steps);
    if (least == 1 << 30) continue;
    const OpenSpace::Wanted found = space.find_wanted(from);
    EXPECT_EQ(walk(space, from, found.way), least);
    EXPECT_EQ(l1(found.way.empty() ? from : found.way.back(), found.voxel), 1);
    EXPECT_EQ(std::count(wanted.begin(), wanted.end(), found.voxel), 1);
  }
}

TEST(OpenSpace, ASearchThatRunsIntoItsLimitFindsNothingAndForgetsItself) {
  OpenSpace space(16);
  space.open({8, 8, 15});
  space.open({8, 8, 14});
  space.open({9, 8, 14});
  EXPECT_FALSE(space.find_way({-1, -1, 0}, {9, 8, 14}, 10).has_value());
  EXPECT_EQ(walk(space, {-1, -1, 0}, space.find_way({-1, -1, 0}, {9, 8, 14}).value()), l1({-1, -1, 0}, {8, 8, 16}) + 3);
}

TEST(OpenSpace, StartsAsAShellWithoutAFloor) {
  const OpenSpace space(8);
  for (Voxel open : {Voxel{-1, 3, 0}, {8, 3, 7}, {3, -1, 4}, {3, 8, 4}, {3, 3, 8}, {-1, -1, 8}})
    EXPECT_TRUE(space.is_open(open));
  for (Voxel closed : {Voxel{0, 0, 0}, {3, 3, -1}, {-1, 3, -1}, {-2, 3, 3}, {3, 3, 9}, {7, 7, 7}})
    EXPECT_FALSE(space.is_open(closed));
}

}  // namespace
}  // namespace sculpt
