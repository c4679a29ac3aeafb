#include "core/sweep/reach/tool_shadow.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/collision/material.hpp"
#include "core/motion/tool/tool_axes.hpp"

namespace sculpt {
namespace {

constexpr double just_below_half = 0.5 - 1e-9;

VoxelSet random_voxels(int n, double share, Random& random) {
  VoxelSet voxels(n);
  for (std::uint64_t& word : voxels.words())
    for (int bit = 0; bit < 64; ++bit)
      if (random.unit() < share) word |= std::uint64_t{1} << bit;
  return voxels;
}

Voxel random_voxel(int n, Random& random) {
  const auto below_n = [&] { return static_cast<int>(random.next() % static_cast<unsigned>(n)); };
  return {below_n(), below_n(), below_n()};
}

std::vector<Voxel> tilted_steps() {
  std::vector<Voxel> steps = tool_steps();
  std::erase_if(steps, [](Voxel step) { return l1(step, {}) == 1; });
  return steps;
}

Segment ray_from(const Vec3& ball, Voxel lean, int n) {
  return {ball, ball + 2.0 * n * Vec3(lean.i, lean.j, lean.k)};
}

Vec3 centre(Voxel v) {
  return Vec3(v.i + 0.5, v.j + 0.5, v.k + 0.5);
}

TEST(ToolShadow, IsWhereACapsuleFromTheVoxelAlongTheAxisMeetsAnother) {
  for (const Voxel lean : tilted_steps())
    for (const int n : {4, 8, 64, 128}) {
      SCOPED_TRACE(::testing::Message() << "n " << n << ", lean " << lean.i << lean.j << lean.k);
      Random random(static_cast<std::uint64_t>(n));
      const VoxelSet standing = random_voxels(n, 2.0 / n, random);
      const Material material(standing);
      const ToolShadow shadow(standing, lean);
      int clear = 0;
      for (int trial = 0; trial < 500; ++trial) {
        const Voxel v = random_voxel(n, random);
        for (const double radius : {0.05, just_below_half})
          ASSERT_EQ(shadow.is_clear(v), !material.meets_capsule(ray_from(centre(v), lean, n), radius, v))
              << v.i << ' ' << v.j << ' ' << v.k << ", radius " << radius;
        clear += shadow.is_clear(v);
      }
      EXPECT_GT(clear, 20);
      EXPECT_LT(clear, 480);
    }
}

/// The lemma that lets the ball go from cell to cell: between two neighbours, or two cells on one line along the axis,
/// the tool meets nothing that it does not meet at one of the two.
TEST(ToolShadow, BetweenTwoClearCellsTheToolIsClearToo) {
  const int n = 8;
  for (const Voxel lean : tilted_steps()) {
    std::vector<Voxel> ways{lean};
    ways.insert(ways.end(), face_steps.begin(), face_steps.end());
    Random random(7);
    int tried = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const VoxelSet standing = random_voxels(n, random.between(0, 0.2), random);
      const Material material(standing);
      const ToolShadow shadow(standing, lean);
      const Voxel from = random_voxel(n, random);
      for (const Voxel way : ways) {
        const Voxel to = from + way;
        if (!Grid{n, 1, Vec3::Zero()}.contains(to) || !shadow.is_clear(from) || !shadow.is_clear(to)) continue;
        if (standing.contains(from)) continue;
        ++tried;
        for (double t = 0; t <= 1; t += 1.0 / 64)
          ASSERT_FALSE(material.meets_capsule(ray_from(centre(from) + t * Vec3(way.i, way.j, way.k), lean, n),
                                              just_below_half, to))
              << "seed 7, trial " << trial << ", t " << t;
      }
    }
    EXPECT_GT(tried, 20);
  }
}

TEST(ToolShadow, FollowsWhatIsRemovedAndPutBackAsIfCastAnew) {
  const int n = 8;
  for (const Voxel lean : tilted_steps()) {
    SCOPED_TRACE(::testing::Message() << "lean " << lean.i << lean.j << lean.k);
    Random random(3);
    ToolShadow shadow(random_voxels(n, 0.4, random), lean);
    int lit = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const Voxel v = random_voxel(n, random);
      const ToolShadow before = shadow;
      VoxelSet told(n);
      if (shadow.standing().contains(v))
        shadow.remove(v, [&](Voxel u) { told.insert(u); });
      else
        shadow.put_back(v);
      const ToolShadow anew(shadow.standing(), lean);
      for_each_voxel(VoxelSet(n, true), [&](Voxel u) {
        ASSERT_EQ(shadow.is_clear(u), anew.is_clear(u));
        ASSERT_EQ(told.contains(u), shadow.is_clear(u) && !before.is_clear(u));
      });
      lit += static_cast<int>(told.size());
    }
    EXPECT_GT(lit, 20);
  }
}

}  // namespace
}  // namespace sculpt
