#include "core/mill/rough/clearing.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace sculpt {
namespace {

MillTool ball_tool(double diameter_m) {
  MillTool tool;
  tool.name = "ball";
  tool.cutter = {CutterKind::ball, diameter_m / 2, diameter_m / 2, 3 * diameter_m};
  tool.max_depth_m = tool.max_width_m = diameter_m / 2;
  return tool;
}

/// A block of 0.1 m, its top at 0, in the middle of a lattice that is 0.03 m wider on all sides.
StockTop make_block(const MillTool& tool, double step_m) {
  const int cells = static_cast<int>(0.16 / step_m);
  HeightMap stands(Lattice{-0.08, -0.08, step_m, cells, cells});
  for (int b = 0; b < cells; ++b)
    for (int a = 0; a < cells; ++a)
      if (std::abs(stands.lattice.u(a)) < 0.05 && std::abs(stands.lattice.v(b)) < 0.05) stands.raise(a, b, 0);
  return {std::move(stands), tool.cutter, 0};
}

struct Cleared {
  double path_m = 0, volume_m3 = 0, max_share = 0, in_passes_m = 0;
  std::size_t passes = 0, entries = 0;
};

/// All that can be come to at a level; each edge is measured by itself on a surface of its own.
Cleared clear_level(const MillTool& tool, StockTop& surface, StockTop& measured, double height,
                    const std::vector<char>& free, RowLayout layout) {
  Cleared cleared;
  Clearing clearing({tool, height, 0.35, free}, layout, surface);
  Point2 at(-0.075, -0.075);
  bool is_down = false;
  double window_m = 0, window_m3 = 0;  // over a radius
  while (std::optional<LevelPass> pass = clearing.next_from(at, is_down)) {
    ++cleared.passes;
    if (!is_down || pass->front() != at) ++cleared.entries;
    is_down = true;
    for (std::size_t n = 0; n + 1 < pass->size(); ++n) {
      const Vec3 from((*pass)[n].x(), (*pass)[n].y(), height), to((*pass)[n + 1].x(), (*pass)[n + 1].y(), height);
      const double volume = measured.volume(from, to), length = (to - from).norm();
      measured.cut(from, to, [](std::size_t, float) {});
      cleared.volume_m3 += volume;
      cleared.path_m += length;
      if (volume > 0) cleared.in_passes_m += length;
      window_m += length;
      window_m3 += volume;
      if (window_m >= tool.cutter.radius_m) {
        cleared.max_share = std::max(cleared.max_share, window_m3 / window_m / (tool.max_depth_m * tool.max_width_m));
        window_m = window_m3 = 0;
      }
    }
    at = pass->back();
  }
  return cleared;
}

TEST(Clearing, ClearsABlockWithoutEverTakingTooMuch) {
  const MillTool tool = ball_tool(0.02);
  StockTop surface = make_block(tool, 0.0008), measured = surface;
  const std::vector<char> free(surface.lattice().size(), 1);
  double volume = 0, path = 0;
  for (int level = 1; level <= 4; ++level) {
    const Cleared cleared = clear_level(tool, surface, measured, -0.01 * level, free, RowLayout::along_u);
    std::cout << "level " << level << ": path " << cleared.path_m << " m (" << cleared.in_passes_m << "), volume "
              << cleared.volume_m3 * 1e6 << " cm3, ideal path " << cleared.volume_m3 / 1e-4 << ", largest "
              << cleared.max_share << ", passes " << cleared.passes << ", entries " << cleared.entries << "\n";
    EXPECT_LE(cleared.max_share, 1.06);
    volume += cleared.volume_m3;
    path += cleared.path_m;
  }
  EXPECT_GT(volume, 0.9 * 0.1 * 0.1 * 0.04);
  EXPECT_LT(path, 1.5 * volume / (tool.max_depth_m * tool.max_width_m));
}

class LaidRows : public testing::TestWithParam<RowLayout> {};

TEST_P(LaidRows, GoAroundWhatIsNotFree) {
  const MillTool tool = ball_tool(0.012);
  StockTop surface = make_block(tool, 0.0006), measured = surface;
  std::vector<char> free(surface.lattice().size(), 1);
  const auto is_island = [](double u, double v) { return std::hypot(u - 0.01, v) < 0.02; };
  for (int b = 0; b < surface.lattice().height; ++b)
    for (int a = 0; a < surface.lattice().width; ++a)
      if (is_island(surface.lattice().u(a), surface.lattice().v(b))) free[surface.lattice().index(a, b)] = 0;
  const Cleared cleared = clear_level(tool, surface, measured, -0.006, free, GetParam());
  std::cout << "island: path " << cleared.path_m << " m, ideal " << cleared.volume_m3 / 36e-6 << ", largest "
            << cleared.max_share << ", passes " << cleared.passes << ", entries " << cleared.entries << "\n";
  EXPECT_LE(cleared.max_share, 1.06);
  EXPECT_LT(cleared.path_m, 1.8 * cleared.volume_m3 / 36e-6);
  // What stands after it: the island less what the cutter reaches of it from beside, and cusps.
  for (int b = 0; b < surface.lattice().height; ++b)
    for (int a = 0; a < surface.lattice().width; ++a) {
      const double u = surface.lattice().u(a), v = surface.lattice().v(b);
      const float top = surface.map().at(a, b);
      if (top == no_height) continue;
      if (std::hypot(u - 0.01, v) < 0.02 - 0.006) {
        EXPECT_EQ(top, 0.0F);
      } else if (std::hypot(u - 0.01, v) > 0.03) {
        EXPECT_LT(top, -0.002F) << u << " " << v;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(EachLayout, LaidRows,
                         testing::Values(RowLayout::around, RowLayout::along_u, RowLayout::along_v));

}  // namespace
}  // namespace sculpt
