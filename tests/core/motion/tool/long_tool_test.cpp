#include "core/motion/tool/long_tool.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/motion/tool/tool_axes.hpp"
#include "tests/core/base/cases.hpp"

namespace sculpt {
namespace {

/// Does anything stand in the way of a tool without end whose ball is at `v`?
bool fits(const VoxelSet& standing, Voxel v, Voxel lean) {
  const Grid grid{standing.n(), 1, Vec3::Zero()};
  for (Voxel ball = v; grid.contains(ball); ball = ball + lean)
    for (int part = 1; part < 8; ++part) {
      const Voxel beside = ball + Voxel{(part & 1) * lean.i, (part >> 1 & 1) * lean.j, (part >> 2) * lean.k};
      if (beside != ball && grid.contains(beside) && standing.contains(beside)) return false;
    }
  return true;
}

/// One after the other, until none fits any more.
void take_one_by_one(Voxel lean, const VoxelSet& wanted, VoxelSet& standing) {
  for (bool taken = true; taken;) {
    taken = false;
    for_each_voxel(wanted, [&](Voxel v) {
      if (!standing.contains(v) || !fits(standing, v, lean)) return;
      standing.erase(v);
      taken = true;
    });
  }
}

TEST(LongTool, TakesWhatCanBeTakenOneByOne) {
  std::size_t taken = 0;
  for (std::uint64_t seed = 0; seed < cases(40u); ++seed) {
    Random random(seed);
    const int n = 4 << seed % 6;  // rows of less than a word, of one and of two
    VoxelSet standing(n), wanted(n);
    const auto place = [&] { return static_cast<int>(random.next() % static_cast<std::uint64_t>(n)); };
    if (n <= 16) {
      const double stands = random.unit(), is_wanted = random.unit();
      for_each_voxel(VoxelSet(n, true), [&](Voxel v) {
        if (random.unit() < stands) standing.insert(v);
        if (random.unit() < is_wanted) wanted.insert(v);
      });
    } else {
      // Rods, most of them wanted: in rows, across them, and over the ends of words.
      for (int rod = 0; rod < 60; ++rod) {
        const Voxel step = face_steps[random.next() % 6];
        const bool take = random.unit() < 0.8;
        Voxel v{place(), place(), place()};
        for (int part = 0; part < 40 && Grid{n, 1, Vec3::Zero()}.contains(v); ++part, v = v + step) {
          standing.insert(v);
          if (take) wanted.insert(v);
        }
      }
    }
    for (const Voxel lean : tool_steps()) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", n " << n << ", axis " << lean.i << " " << lean.j << " "
                                        << lean.k);
      VoxelSet swept = standing, one_by_one = standing;
      const bool any = peel_along(lean, wanted, swept);
      take_one_by_one(lean, wanted, one_by_one);
      ASSERT_EQ(swept, one_by_one);
      ASSERT_EQ(any, swept.size() < standing.size());
      ASSERT_FALSE(peel_along(lean, wanted, swept)) << "a second sweep";
      taken += standing.size() - swept.size();
    }
  }
  EXPECT_GT(taken, 10000u);
}

}  // namespace
}  // namespace sculpt
