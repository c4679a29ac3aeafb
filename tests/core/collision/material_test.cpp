#include "core/collision/material.hpp"

#include <gtest/gtest.h>

#include "tests/core/base/cases.hpp"
#include "tests/core/material/random_voxels.hpp"

namespace sculpt {
namespace {

bool meets_by_brute_force(const VoxelSet& voxels, const Segment& segment, double radius, std::optional<Voxel> exempt) {
  for (int k = 0; k < voxels.n(); ++k)
    for (int j = 0; j < voxels.n(); ++j)
      for (int i = 0; i < voxels.n(); ++i) {
        const Voxel v{i, j, k};
        if (!voxels.contains(v) || exempt == v) continue;
        if (distance_to_box(segment, Vec3(i, j, k), Vec3(i + 1, j + 1, k + 1)) < radius) return true;
      }
  return false;
}

TEST(Material, CapsuleMeetsExactlyWhatBruteForceFinds) {
  unsigned met = 0;
  constexpr unsigned tried = cases(4000u);
  for (std::uint64_t seed = 0; seed < tried; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const VoxelSet voxels = random_voxels(8, random.between(0, 0.06), random);
    const Material material(voxels);
    const auto point = [&] { return Vec3(random.between(-2, 10), random.between(-2, 10), random.between(-2, 10)); };
    Segment segment{point(), point()};
    if (seed % 3 == 0) segment.b = segment.a + Vec3::Unit(static_cast<int>(seed / 3 % 3)) * random.between(-8, 8);
    if (seed % 7 == 0) segment.b = segment.a;
    const double radius = random.between(0.05, 1.6);
    const Voxel exempt{static_cast<int>(random.next() % 8), static_cast<int>(random.next() % 8),
                       static_cast<int>(random.next() % 8)};
    const bool expected = meets_by_brute_force(voxels, segment, radius, exempt);
    EXPECT_EQ(material.meets_capsule(segment, radius, exempt), expected);
    met += expected;
  }
  EXPECT_GT(met, tried / 10) << "the cases must hold hits and misses";
  EXPECT_LT(met, tried * 9 / 10);
}

TEST(Material, ABallOf045FitsAOneVoxelSlotAndOneOf051DoesNot) {
  VoxelSet voxels(8, true);
  for (int k = 0; k < 8; ++k) voxels.erase({3, 3, k});
  const Material material(voxels);
  const Segment column{{3.5, 3.5, 0.5}, {3.5, 3.5, 20}};
  EXPECT_FALSE(material.meets_capsule(column, 0.45, {}));
  EXPECT_TRUE(material.meets_capsule(column, 0.51, {}));
}

}  // namespace
}  // namespace sculpt
