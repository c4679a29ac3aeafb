#include "core/mill/finish/rows/thinning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sculpt {
namespace {

const Lattice lattice{0, 0, 1, 60, 60};

std::vector<char> marked(const auto& is_marked) {
  std::vector<char> cells(lattice.size());
  for (int b = 2; b + 2 < lattice.height; ++b)
    for (int a = 2; a + 2 < lattice.width; ++a) cells[lattice.index(a, b)] = is_marked(a, b);
  return cells;
}

int ends(const std::vector<char>& cells) {
  int count = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    count += cells[cell] != 0 && branches(cells, lattice, cell) == 1;
  return count;
}

TEST(Thinning, LeavesTheMiddleOfABar) {
  std::vector<char> bar = marked([](int a, int b) { return a >= 5 && a < 50 && b >= 20 && b < 27; });
  thin(bar, lattice);
  EXPECT_EQ(ends(bar), 2);
  for (int a = 12; a < 43; ++a)
    for (int b = 0; b < 60; ++b) EXPECT_EQ(bar[lattice.index(a, b)] != 0, b == 23) << a << ' ' << b;
}

TEST(Thinning, ARingStaysARingAndACrossHasFourEnds) {
  std::vector<char> ring = marked([](int a, int b) {
    const double far = std::hypot(a - 30, b - 30);
    return far > 12 && far < 20;
  });
  thin(ring, lattice);
  EXPECT_EQ(ends(ring), 0);
  EXPECT_GT(std::ranges::count(ring, 1), 80);
  std::vector<char> cross = marked([](int a, int b) { return std::abs(a - 30) < 3 || std::abs(b - 30) < 3; });
  thin(cross, lattice);
  EXPECT_EQ(ends(cross), 4);
}

}  // namespace
}  // namespace sculpt
