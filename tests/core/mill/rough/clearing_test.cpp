#include "core/mill/rough/clearing.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <iostream>
#include <numbers>
#include <random>

#include "core/mill/rough/cells_to_clear.hpp"

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

/// What is taken off over the last diameter of path, whatever edges it is of.
class Engagement {
 public:
  explicit Engagement(const MillTool& tool) : tool_(tool) {}

  void add(double volume_m3, double length_m) {
    bits_.emplace_back(volume_m3, length_m);
    volume_m3_ += volume_m3;
    length_m_ += length_m;
    while (length_m_ - bits_.front().second >= 2 * tool_.cutter.radius_m) {
      volume_m3_ -= bits_.front().first;
      length_m_ -= bits_.front().second;
      bits_.pop_front();
    }
    if (length_m_ >= 2 * tool_.cutter.radius_m)
      max_share_ = std::max(max_share_, volume_m3_ / length_m_ / (tool_.max_depth_m * tool_.max_width_m));
  }
  void end() {
    bits_.clear();
    volume_m3_ = length_m_ = 0;
  }
  double max_share() const { return max_share_; }

 private:
  const MillTool& tool_;
  std::deque<std::pair<double, double>> bits_;
  double volume_m3_ = 0, length_m_ = 0, max_share_ = 0;
};

/// All that can be come to at a level; measured bit by bit on a surface of its own.
Cleared clear_level(const MillTool& tool, StockTop& surface, StockTop& measured, double height,
                    const std::vector<char>& free, RowLayout layout) {
  Cleared cleared;
  const double cusp_m = 0.35 * tool.max_depth_m;
  const CellsToClear cells = find_cells_to_clear(tool.cutter, height, cusp_m, free, surface.map(), Helpers(1));
  Clearing clearing({tool, height, cusp_m, free, cells.marked, 0, [](const Vec3&) { return 0.0; }}, layout, surface);
  Vec3 at(-0.075, -0.075, 0);
  bool is_down = false;
  Engagement engagement(tool);
  while (std::optional<LevelPass> pass = clearing.next_from(at.head<2>(), is_down)) {
    ++cleared.passes;
    if (!is_down || pass->front() != at) {
      ++cleared.entries;
      engagement.end();
    }
    is_down = true;
    for (std::size_t n = 0; n + 1 < pass->size(); ++n) {
      const Vec3 &from = (*pass)[n], &to = (*pass)[n + 1];
      const double length = (to - from).norm();
      const int bits = 1 + static_cast<int>(length / (tool.cutter.radius_m / 8));
      double volume = 0;
      for (int bit = 0; bit < bits; ++bit) {
        const Vec3 begin = from + (to - from) * bit / bits, end = from + (to - from) * (bit + 1) / bits;
        const double more = measured.cut(begin, end);
        engagement.add(more, length / bits);
        volume += more;
      }
      cleared.volume_m3 += volume;
      cleared.path_m += length;
      if (volume > 0) cleared.in_passes_m += length;
    }
    at = pass->back();
    EXPECT_EQ(at.z(), height);
  }
  cleared.max_share = engagement.max_share();
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
    EXPECT_LE(cleared.max_share, 1.1);
    volume += cleared.volume_m3;
    path += cleared.path_m;
  }
  EXPECT_GT(volume, 0.9 * 0.1 * 0.1 * 0.04);
  EXPECT_LT(path, 1.25 * volume / (tool.max_depth_m * tool.max_width_m));
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
  EXPECT_LE(cleared.max_share, 1.1);
  EXPECT_LT(cleared.path_m, 1.5 * cleared.volume_m3 / 36e-6);
  // What stands after it: the island less what the cutter reaches of it from beside, and cusps.
  for (int b = 0; b < surface.lattice().height; ++b)
    for (int a = 0; a < surface.lattice().width; ++a) {
      const double u = surface.lattice().u(a), v = surface.lattice().v(b);
      const float top = surface.map().at(a, b);
      if (top == no_height) continue;
      if (std::hypot(u - 0.01, v) < 0.02 - 0.006) {
        EXPECT_EQ(top, 0.0F);
      } else if (std::hypot(u - 0.01, v) > 0.03) {
        ASSERT_LT(top, -0.002F) << u << " " << v;
      }
    }
}

/// Nowhere may the tip be but in a pocket: it comes down along ramps, and takes no more there than a slot may.
TEST_P(LaidRows, EnterAPocketByRamps) {
  for (const CutterKind kind : {CutterKind::ball, CutterKind::flat}) {
    MillTool tool = ball_tool(0.012);
    tool.cutter.kind = kind;
    if (kind == CutterKind::flat) tool.cutter.corner_radius_m = 0;
    StockTop surface = make_block(tool, 0.0006), measured = surface;
    const Lattice lattice = surface.lattice();
    std::vector<char> free(lattice.size());
    std::size_t cells = 0;
    for (int b = 0; b < lattice.height; ++b)
      for (int a = 0; a < lattice.width; ++a)
        if (std::abs(lattice.u(a)) < 0.03 && std::abs(lattice.v(b) - 0.01) < 0.02) {
          free[lattice.index(a, b)] = 1;
          ++cells;
        }
    double volume = 0;
    for (int level = 1; level <= 2; ++level) {
      const Cleared cleared = clear_level(tool, surface, measured, -0.006 * level, free, GetParam());
      EXPECT_LE(cleared.max_share, 1.2) << "level " << level;
      volume += cleared.volume_m3;
    }
    EXPECT_GT(volume, 0.8 * 0.012 * static_cast<double>(cells) * lattice.step * lattice.step);
  }
}

/// Ways from pass to pass go over gaps and through what stands beyond them.
TEST_P(LaidRows, TakeNoMoreThanTheyMayWhereStockStandsInBits) {
  const MillTool tool = ball_tool(0.02);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    HeightMap stands = make_block(tool, 0.0008).map();
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(-0.05, 0.05), size(0.004, 0.02);
    for (int hole = 0; hole < 12; ++hole) {
      const Point2 middle(place(random), place(random));
      const double radius = size(random);
      for (int b = 0; b < stands.lattice.height; ++b)
        for (int a = 0; a < stands.lattice.width; ++a)
          if ((Point2(stands.lattice.u(a), stands.lattice.v(b)) - middle).norm() < radius)
            stands.heights[stands.lattice.index(a, b)] = no_height;
    }
    StockTop surface(stands, tool.cutter, 0), measured = surface;
    std::vector<char> free(surface.lattice().size(), 1);
    free[surface.lattice().index(100, 100)] = 0;
    const Cleared cleared = clear_level(tool, surface, measured, -0.01, free, GetParam());
    std::cout << "seed " << seed << ": path " << cleared.path_m << " m, ideal " << cleared.volume_m3 / 1e-4
              << ", largest " << cleared.max_share << ", passes " << cleared.passes << "\n";
    EXPECT_GT(cleared.volume_m3, 0) << "seed " << seed;
    EXPECT_LE(cleared.max_share, 1.2) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(EachLayout, LaidRows,
                         testing::Values(RowLayout::around, RowLayout::along_u, RowLayout::along_v));

}  // namespace
}  // namespace sculpt
