#include "core/mill/rough/cell_distances.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

int whole(Random& random, int low, int high) {
  return static_cast<int>(random.between(low, high + 1));
}

TEST(CellDistances, AreThoseOfBruteForce) {
  const Helpers helpers(3);
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    const Lattice lattice{0, 0, 0.5, whole(random, 2, 41), whole(random, 2, 41)};
    std::vector<char> marked(lattice.size());
    for (int n = whole(random, 1, 12); n > 0; --n)
      marked[static_cast<std::size_t>(whole(random, 0, static_cast<int>(lattice.size()) - 1))] = 1;
    const std::vector<float> found = distances_to(marked, lattice);
    ASSERT_EQ(distances_to(marked, lattice, &helpers), found) << "seed " << seed << ": on three threads";
    for (int b = 0; b < lattice.height; ++b)
      for (int a = 0; a < lattice.width; ++a) {
        double nearest = HUGE_VAL;
        for (int d = 0; d < lattice.height; ++d)
          for (int c = 0; c < lattice.width; ++c)
            if (marked[lattice.index(c, d)]) nearest = std::min(nearest, 0.5 * std::hypot(a - c, b - d));
        ASSERT_NEAR(found[lattice.index(a, b)], nearest, 1e-5) << "seed " << seed << ": " << a << " " << b;
      }
  }
}

TEST(CellDistances, WhereNothingIsMarkedAreLong) {
  const Lattice lattice{0, 0, 0.5, 7, 9};
  for (const float distance : distances_to(std::vector<char>(lattice.size()), lattice)) EXPECT_GE(distance, 0.5F * 9);
}

}  // namespace
}  // namespace sculpt
