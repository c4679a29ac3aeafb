#include "core/search/voxel_sections.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/core/search/replay.hpp"

namespace sculpt {
namespace {

TEST(TakeSection, TakesWhatAPlainFloodComesToAndNothingElse) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    constexpr int n = 8;
    const Grid grid{n, 1, Vec3::Zero()};
    const VoxelGrid voxels = random_voxels(n, seed);
    VoxelTree waiting(n), section(n);
    std::vector<Voxel> all;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          if (voxels.label({i, j, k}) == Label::remove) all.push_back({i, j, k});
    if (all.empty()) continue;
    for (Voxel v : all) waiting.insert(v);
    std::vector<Voxel> stack{all[all.size() / 2]};
    std::set<Voxel> expected{stack[0]};
    while (!stack.empty()) {
      const Voxel v = stack.back();
      stack.pop_back();
      for (Voxel step : face_steps) {
        const Voxel w = v + step;
        if (grid.contains(w) && voxels.label(w) == Label::remove && expected.insert(w).second) stack.push_back(w);
      }
    }
    auto outer = take_section(n, all[all.size() / 2], waiting, section, [] {});
    std::vector<Voxel> expected_outer;
    for (Voxel v : all) {
      ASSERT_EQ(section.contains(v), expected.contains(v));
      ASSERT_EQ(waiting.contains(v), !expected.contains(v));
      const bool on_face = v.i == 0 || v.j == 0 || v.i == n - 1 || v.j == n - 1 || v.k == n - 1;
      if (on_face && expected.contains(v)) expected_outer.push_back(v);
    }
    std::sort(outer.begin(), outer.end());
    std::sort(expected_outer.begin(), expected_outer.end());
    EXPECT_EQ(outer, expected_outer);
  }
}

TEST(FindStart, IsNearestToACornerAndOfEqualsNearestToTheRobot) {
  EXPECT_EQ(find_start(8, {{4, 0, 4}, {0, 3, 3}, {7, 1, 5}, {3, 3, 7}}, {0, 0, 8}), (Voxel{7, 1, 5}));
  EXPECT_EQ(find_start(8, {{7, 7, 7}, {0, 0, 0}, {7, 0, 7}}, {6, 0, 8}), (Voxel{7, 0, 7}));
  EXPECT_EQ(find_start(8, {{7, 7, 7}, {0, 0, 7}}, {0, 7, 8}), (Voxel{0, 0, 7})) << "all equal: the lowest";
}

}  // namespace
}  // namespace sculpt
