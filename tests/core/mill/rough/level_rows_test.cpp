#include "core/mill/rough/level_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/base/random.hpp"
#include "core/mill/rough/cell_distances.hpp"

namespace sculpt {
namespace {

constexpr double radius = 0.01, width = 0.01, cleared = 0.0073, inside = 0.002;

/// A square that is to come off, the tip kept out of discs in it.
struct Level {
  Lattice lattice{-0.09, -0.09, 0.001, 180, 180};
  std::vector<char> is_free = std::vector<char>(lattice.size(), 1), stands = std::vector<char>(lattice.size());

  explicit Level(const std::vector<std::pair<Point2, double>>& discs) {
    for (int b = 0; b < lattice.height; ++b)
      for (int a = 0; a < lattice.width; ++a) {
        const Point2 p(lattice.u(a), lattice.v(b));
        stands[lattice.index(a, b)] = p.cwiseAbs().maxCoeff() < 0.05 ? 1 : 0;
        for (const auto& [middle, size] : discs) {
          if ((p - middle).norm() < size) is_free[lattice.index(a, b)] = 0;
        }
      }
    // What the cutter does not come to by its side.
    const std::vector<float> far = distances_to(is_free, lattice);
    for (std::size_t at = 0; at < stands.size(); ++at)
      if (far[at] > 0.006F) stands[at] = 0;
  }
  LevelArea task() const { return {lattice, is_free, stands, radius, width, cleared, inside, 0.008}; }
};

double distance_to(const Point2& p, const LevelRow& row) {
  double nearest = HUGE_VAL;
  for (std::size_t at = 0; at + 1 < row.points.size(); ++at) {
    const Point2 way = row.points[at + 1] - row.points[at];
    const double t = std::clamp((p - row.points[at]).dot(way) / way.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - row.points[at] - t * way).norm());
  }
  return nearest;
}

class Layouts : public testing::TestWithParam<RowLayout> {};

TEST_P(Layouts, ComeNearToAllThatIsToComeOffAndGoNowhereElse) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Random random(seed);
    std::vector<std::pair<Point2, double>> discs;
    for (int n = static_cast<int>(random.between(1, 4)); n > 0; --n)
      discs.emplace_back(Point2(random.between(-0.04, 0.04), random.between(-0.04, 0.04)), random.between(0.008, 0.02));
    const Level level(discs);
    const LevelRows laid(level.task(), GetParam());
    ASSERT_FALSE(laid.rows().empty());
    for (const LevelRow& row : laid.rows())
      for (const Point2& p : row.points) {
        const Lattice& cells = level.lattice;
        ASSERT_TRUE(level.is_free[cells.index(cells.cell_u(p.x()), cells.cell_v(p.y()))]) << "seed " << seed;
        ASSERT_LT(p.cwiseAbs().maxCoeff(), 0.05 + radius + 0.001) << "seed " << seed;
      }
    for (int b = 0; b < level.lattice.height; ++b)
      for (int a = 0; a < level.lattice.width; ++a) {
        if (!level.stands[level.lattice.index(a, b)]) continue;
        double nearest = HUGE_VAL;
        for (const LevelRow& row : laid.rows())
          nearest = std::min(nearest, distance_to({level.lattice.u(a), level.lattice.v(b)}, row));
        EXPECT_LT(nearest, cleared + 0.0015)
            << "seed " << seed << ": " << level.lattice.u(a) << " " << level.lattice.v(b);
      }
  }
}

TEST_P(Layouts, WhereNothingStandsAreEmpty) {
  Level level({});
  level.stands.assign(level.stands.size(), 0);
  EXPECT_TRUE(LevelRows(level.task(), GetParam()).rows().empty());
}

INSTANTIATE_TEST_SUITE_P(LevelRows, Layouts,
                         testing::Values(RowLayout::around, RowLayout::along_u, RowLayout::along_v));

TEST(LevelRows, AroundNothingThereAreNone) {
  const Level level({});
  EXPECT_TRUE(LevelRows(level.task(), RowLayout::around).rows().empty());
  EXPECT_FALSE(LevelRows(level.task(), RowLayout::along_u).rows().empty());
}

/// Where the straight rows of a level are across, those farther than `least` from its middle line on one side.
std::vector<double> across(const Level& level, double least) {
  const LevelRows laid(level.task(), RowLayout::along_u);
  std::vector<double> at;
  for (const LevelRow& row : laid.rows())
    if (row.rank >= 0 && row.points.front().y() > least) at.push_back(row.points.front().y());
  std::ranges::sort(at);
  return at;
}

void expect_even(const std::vector<double>& at) {
  for (std::size_t row = 1; row < at.size(); ++row) {
    EXPECT_LE(at[row] - at[row - 1], width + 1e-6);
    EXPECT_NEAR(at[row] - at[row - 1], at[1] - at[0], 1e-5);
  }
}

TEST(LevelRows, StraightOnesGoFromOneSideToTheOther) {
  const Level level({});
  const std::vector<double> at = across(level, -1);
  ASSERT_EQ(at.size(), 11);  // from 7.3 mm inside of one edge to 2 mm inside of the other, 100 mm away
  EXPECT_NEAR(at.front(), -0.05 + cleared, level.lattice.step);
  EXPECT_NEAR(at.back(), 0.05 - inside, level.lattice.step);
  expect_even(at);
}

TEST(LevelRows, StraightOnesGoFromBothSidesToTheMiddleBesideThePart) {
  const Level level({{{0.04, 0}, 0.002}});
  const std::vector<double> at = across(level, 0);
  ASSERT_GE(at.size(), 6);  // between 2 mm inside of an edge 50 mm from the middle and 7.3 mm beside the middle
  EXPECT_NEAR(at.back(), 0.05 - inside, level.lattice.step);
  EXPECT_NEAR(at.front(), cleared, level.lattice.step);
}

TEST(LevelRows, StraightOnesLeaveSomethingForTheRingAroundThePart) {
  const double disc = 0.02;
  const Level level({{{0, 0}, disc}});
  const LevelRows laid(level.task(), RowLayout::along_u);
  double ring = 0;
  for (const LevelRow& row : laid.rows())
    for (std::size_t at = 0; at + 1 < row.points.size(); ++at) {
      const Point2& p = row.points[at];
      if (row.rank < 0) ring += (row.points[at + 1] - p).norm();
      // Those that come straight towards it.
      if (row.rank >= 0 && std::abs(p.y()) < disc / 2) {
        EXPECT_GT(p.norm() - disc, width / 2);
      }
    }
  EXPECT_GT(ring, 2 * std::numbers::pi * disc);
}

/// A slot through which the tip may go in a passage of so many cells, here and there one to the side.
Level passage(int cells) {
  Level level({});
  const Lattice& all = level.lattice;
  for (int b = 0; b < all.height; ++b)
    for (int a = 0; a < all.width; ++a) {
      const int shift = a < 80 ? 0 : 1;
      level.is_free[all.index(a, b)] = a > 40 && a < 140 && b >= 90 + shift && b < 90 + shift + cells ? 1 : 0;
      level.stands[all.index(a, b)] = a > 38 && a < 142 && b > 86 && b < 96 ? 1 : 0;
    }
  return level;
}

TEST(LevelRows, GoThroughPassagesOfAFewCells) {
  for (const RowLayout layout : {RowLayout::around, RowLayout::along_u, RowLayout::along_v})
    for (const int cells : {2, 3, 4, 5}) {
      const Level level = passage(cells);
      const LevelRows laid(level.task(), layout);
      double first = 1, last = -1;
      for (const LevelRow& row : laid.rows())
        for (std::size_t at = 0; at < row.points.size(); ++at) {
          EXPECT_TRUE(edge_is_free(level.lattice, level.is_free, row.points[at > 0 ? at - 1 : 0], row.points[at]));
          first = std::min(first, row.points[at].x());
          last = std::max(last, row.points[at].x());
        }
      EXPECT_LT(first, level.lattice.u(44)) << cells;
      EXPECT_GT(last, level.lattice.u(136)) << cells;
    }
}

}  // namespace
}  // namespace sculpt
