#include "core/timing/room/open_columns.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

TEST(OpenColumns, SaysWhatLookingVoxelByVoxelSays) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int n = 2 << random.next() % 3;
    const Grid grid{n, 1, Vec3::Zero()};
    const auto index = [&](int wider) {
      return static_cast<int>(random.next() % static_cast<std::uint64_t>(n + 2 * wider)) - wider;
    };
    OpenColumns columns(n);
    std::set<Voxel> removed;
    const auto stands = [&](Voxel voxel) { return grid.contains(voxel) && !removed.contains(voxel); };
    for (int round = 0; round < 400; ++round) {
      const Voxel gone{index(0), index(0), index(0)};
      columns.remove(gone);
      removed.insert(gone);
      const Voxel asked{index(2), index(2), index(2)};
      const std::size_t direction = random.next() % 6;
      const Voxel step = face_steps[direction];
      bool open = true;
      for (int at = 1; at < 2 * n + 8; ++at) open = open && !stands(asked + step * at);
      ASSERT_EQ(columns.is_open(asked, direction, true), open);
      ASSERT_EQ(columns.is_open(asked, direction, false), open && !stands(asked));
      const Voxel high = asked + Voxel{step.i == 0 ? 1 : 0, step.j == 0 ? 2 : 0, step.k == 0 ? 1 : 0};
      bool all = true;
      for (int i = asked.i; i <= high.i; ++i)
        for (int j = asked.j; j <= high.j; ++j)
          for (int k = asked.k; k <= high.k; ++k)
            for (int at = 0; at < 2 * n + 8; ++at) all = all && !stands(Voxel{i, j, k} + step * at);
      ASSERT_EQ(columns.are_open(asked, high, direction, 100), all);
      ASSERT_FALSE(
          columns.are_open({0, 0, 0}, {step.i == 0 ? 9 : 0, step.j == 0 ? 9 : 0, step.k == 0 ? 9 : 0}, direction, 50));
    }
  }
}

}  // namespace
}  // namespace sculpt
