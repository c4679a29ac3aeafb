#include "core/mill/rough/cells_to_clear.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

constexpr double level_m = 0.02, cusp_m = 0.003;

TEST(CellsToClear, AreThoseThatTheCutterLeavesLowerFromSomewhere) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    HeightMap tops(Lattice{0, 0, 1e-3, 25, 18});
    std::vector<char> is_free(tops.lattice.size());
    for (std::size_t at = 0; at < is_free.size(); ++at) {
      is_free[at] = random.between(0, 1) < 0.02;
      tops.heights[at] = static_cast<float>(random.between(0, 0.06));
    }
    const Cutter cutter{CutterKind::ball, 0.006, 0.006, 0.03};
    const CellsToClear found = find_cells_to_clear(cutter, level_m, cusp_m, is_free, tops, Helpers(2));
    double volume_m3 = 0;
    const Lattice& cells = tops.lattice;
    for (int b = 0; b < cells.height; ++b)
      for (int a = 0; a < cells.width; ++a) {
        const auto top = static_cast<double>(tops.at(a, b));
        bool is_lower = false;
        for (int d = 0; d < cells.height; ++d)
          for (int c = 0; c < cells.width; ++c) {
            const double r = (std::hypot(a - c, b - d) + std::numbers::sqrt2) * cells.step;
            is_lower = is_lower || (is_free[cells.index(c, d)] && r < cutter.radius_m &&
                                    level_m + cutter.height_m(r) + cusp_m < top);
          }
        ASSERT_EQ(found.marked[cells.index(a, b)] != 0, is_lower) << "seed " << seed << ": " << a << " " << b;
        if (is_lower) volume_m3 += (top - level_m) * 1e-6;
      }
    EXPECT_NEAR(found.volume_m3, volume_m3, 1e-12) << "seed " << seed;
    EXPECT_GT(found.volume_m3, 0) << "seed " << seed;
  }
}

TEST(CellsToClear, AreNoneWhereNothingStandsHigherThanACusp) {
  HeightMap tops(Lattice{0, 0, 1e-3, 9, 9});
  for (float& height : tops.heights) height = static_cast<float>(level_m + 0.9 * cusp_m);
  const CellsToClear found = find_cells_to_clear({CutterKind::flat, 0.006, 0, 0.03}, level_m, cusp_m,
                                                 std::vector<char>(tops.lattice.size(), 1), tops, Helpers(1));
  EXPECT_EQ(std::ranges::count(found.marked, 0), static_cast<std::ptrdiff_t>(tops.lattice.size()));
  EXPECT_EQ(found.volume_m3, 0);
}

}  // namespace
}  // namespace sculpt
