#include "core/verify/mill/chip_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sculpt {
namespace {

MillTool d12() {
  MillTool tool;
  tool.cutter = {CutterKind::ball, 6e-3, 6e-3, 0.026};
  tool.max_depth_m = 6e-3;
  tool.max_width_m = 6e-3;
  return tool;
}

/// How many middles of voxels are in a range, the grid shifted by so much.
std::uint64_t count(double from, double to, double voxel, double shift) {
  return static_cast<std::uint64_t>(
      std::max(0.0, std::floor((to - shift) / voxel) - std::ceil((from - shift) / voxel) + 1));
}

/// A straight cut along a row of voxels, `depth` by `width` mm, in edges of random lengths. The first finding.
std::string weigh(double depth, double width, double voxel, std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const std::uint64_t across = count(0, depth, voxel, uniform(0, voxel)) * count(0, width, voxel, uniform(0, voxel));
  const double shift = uniform(0, voxel);
  ChipScale scale;
  for (double at = 0; at < 200;) {
    const double next = at + std::exp(uniform(std::log(0.05), std::log(20)));
    const std::string finding = scale.weigh(d12(), across * count(at, next, voxel, shift), voxel, next - at);
    if (!finding.empty()) return finding;
    at = next;
  }
  return {};
}

TEST(ChipScale, BearsWhatTheToolMayTakeHoweverCoarseTheVoxels) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    std::mt19937 random(seed);
    const double voxel = std::exp(std::uniform_real_distribution<double>(std::log(0.3), std::log(8))(random));
    ASSERT_EQ(weigh(6, 6, voxel, random), "") << "seed " << seed << " voxel " << voxel << " mm";
  }
}

TEST(ChipScale, FindsASlotOfFullWidth) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    const double voxel = std::uniform_real_distribution<double>(0.1, 0.9)(random);
    ASSERT_NE(weigh(6, 12, voxel, random), "") << "seed " << seed << " voxel " << voxel << " mm";
  }
}

TEST(ChipScale, DoesNotWeighAcrossTheEndOfARun) {
  ChipScale scale;
  EXPECT_EQ(scale.weigh(d12(), 700, 1, 11), "");  // shorter than a diameter
  scale.end();
  EXPECT_EQ(scale.weigh(d12(), 700, 1, 11), "");
  EXPECT_NE(scale.weigh(d12(), 700, 1, 11), "");
}

}  // namespace
}  // namespace sculpt
