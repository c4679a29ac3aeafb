#include "core/mill/chip_load.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "core/verify/mill/chip_scale.hpp"

namespace sculpt {
namespace {

MillTool d12() {
  MillTool tool;
  tool.cutter = {CutterKind::ball, 6e-3, 6e-3, 0.026};
  tool.max_depth_m = 6e-3;
  tool.max_width_m = 6e-3;
  return tool;
}

constexpr double chip_m2 = 36e-6;

TEST(ChipLoad, BearsDepthTimesWidthForever) {
  ChipLoad load = counted_load(d12(), 1e-3);
  for (int edge = 0; edge < 1000; ++edge) ASSERT_TRUE(load.bears(chip_m2 * 1e-3, 1e-3)) << edge;
}

TEST(ChipLoad, RefusesASlotAtTwiceTheWidth) {
  ChipLoad load = counted_load(d12(), 1e-3);
  int borne = 0;
  while (borne < 1000 && load.bears(2 * chip_m2 * 1e-3, 1e-3)) ++borne;
  EXPECT_GT(borne, 1);   // a layer of voxels
  EXPECT_LT(borne, 12);  // of a millimetre; a diameter of path
}

TEST(ChipLoad, ForgetsWhatWasBeforeTheRun) {
  ChipLoad load = counted_load(d12(), 1e-3);
  while (load.bears(2 * chip_m2 * 1e-3, 1e-3)) {
  }
  load.begin(0);
  EXPECT_TRUE(load.bears(2 * chip_m2 * 1e-3, 1e-3));
}

/// The heaviest stretch of edges (volumes, lengths) that ends with an edge and is no longer, all of its first one
/// counted.
double heaviest_m3(const std::vector<std::pair<double, double>>& edges, double window_m) {
  double heaviest_m3 = 0;
  for (std::size_t first = 0; first < edges.size(); ++first) {
    double volume_m3 = edges[first].first, length_m = 0;
    for (std::size_t last = first + 1; last < edges.size(); ++last) {
      length_m += edges[last].second;
      if (length_m >= window_m) break;
      volume_m3 += edges[last].first;
    }
    heaviest_m3 = std::max(heaviest_m3, volume_m3);
  }
  return heaviest_m3;
}

TEST(ChipLoad, OverACountedWindowNoMoreThanAChip) {
  const double voxel_m = 1e-3, window_m = counted_window_m(d12(), voxel_m);
  EXPECT_DOUBLE_EQ(window_m, 20 * voxel_m);
  EXPECT_DOUBLE_EQ(counted_window_m(d12(), 1e-4), 12e-3) << "a diameter";
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    ChipLoad load = counted_load(d12(), voxel_m);
    std::vector<std::pair<double, double>> borne{{0.5 * chip_m2 * window_m, 0.0}};
    load.begin(borne.front().first);
    for (int edge = 0; edge < 300; ++edge) {
      const double length_m = 3e-3 * uniform(random), most = edge % 2 == 0 ? 3 : 0.5;
      const double volume_m3 = most * uniform(random) * chip_m2 * length_m;
      const double taken_m3 = load.bears(volume_m3, length_m) ? volume_m3 : 0;
      if (taken_m3 == 0) load.bears(0, length_m);  // where nothing stands
      borne.emplace_back(taken_m3, length_m);
    }
    EXPECT_LE(heaviest_m3(borne, window_m), 1.1 * chip_m2 * window_m) << "seed " << seed;
    EXPECT_GT(heaviest_m3(borne, window_m), 0.9 * chip_m2 * window_m) << "seed " << seed;
  }
}

/// Whatever edges are borne, and however the arm cuts them up: a replay finds no chip too thick.
TEST(ChipLoad, IsStricterThanTheReplay) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double voxel_m = std::exp(uniform(std::log(1e-4), std::log(6e-3))), voxel_m3 = std::pow(voxel_m, 3);
    const MillTool tool = d12();
    ChipLoad load = counted_load(tool, voxel_m);
    ChipScale scale;
    double borne_m3 = 0;
    for (int edge = 0; edge < 500; ++edge) {
      const double length_m = std::exp(uniform(std::log(2e-5), std::log(2e-2)));
      const auto voxels =
          static_cast<std::uint64_t>(uniform(0, uniform(0, 4)) * chip_m2 * length_m / voxel_m3 + uniform(0, 1));
      if (!load.bears(static_cast<double>(voxels) * voxel_m3, length_m)) {
        if (uniform(0, 1) < 0.5) continue;  // left out, the next one is tried in the same run
        load.begin(0);
        scale.end();
        continue;
      }
      borne_m3 += static_cast<double>(voxels) * voxel_m3;
      std::uint64_t left = voxels;
      double left_m = length_m;
      for (int part = std::uniform_int_distribution(0, 5)(random); part >= 0; --part) {
        const std::uint64_t some = part == 0 ? left : std::uniform_int_distribution<std::uint64_t>(0, left)(random);
        const double some_m = part == 0 ? left_m : uniform(0, left_m);
        ASSERT_EQ(scale.weigh(tool, some, 1000 * voxel_m, 1000 * some_m), "")
            << "seed " << seed << " edge " << edge << " voxel " << voxel_m;
        left -= some;
        left_m -= some_m;
      }
    }
    EXPECT_GT(borne_m3, 0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace sculpt
