#include "core/mill/map/height_map.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

const std::vector<Direction> directions{{0, 0, 1}, {-1, 0, 0}, {0, 1, 1}, {1, -1, 1}, {26, 0, -15}};

TEST(HeightMap, NoPointOfATriangleIsHigherThanItsCell) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    HeightMap map(Lattice{-0.02, -0.02, random.between(0.0003, 0.003), 60, 60});
    const double size = seed % 3 == 0 ? 0.001 : 0.015;
    const auto corner = [&] {
      return Vec3(random.between(-size, size), random.between(-size, size), random.between(-size, size));
    };
    const Vec3 p = corner(), q = corner(), r = seed % 5 == 0 ? Vec3(p + (q - p) * 0.5 + Vec3(0, 0, 0.01)) : corner();
    map.raise(p, q, r);
    const double top = std::max({p.z(), q.z(), r.z()});
    for (int n = 0; n < 500; ++n) {
      double s = random.unit(), t = random.unit();
      if (s + t > 1) s = 1 - s, t = 1 - t;
      const Vec3 at = p + s * (q - p) + t * (r - p);
      const int a = map.lattice.cell_u(at.x()), b = map.lattice.cell_v(at.y());
      if (!map.lattice.contains(a, b)) continue;
      EXPECT_GE(static_cast<double>(map.at(a, b)), at.z() - 1e-9);
      EXPECT_LE(static_cast<double>(map.at(a, b)), top + 1e-6);
    }
  }
}

TEST(HeightMap, NoPointOfAStandingVoxelIsHigherThanItsCell) {
  const Helpers helpers(3);
  for (const int n : {8, 64}) {
    const Grid grid{n, 0.08 / n, Vec3(-0.04, -0.03, 0.01)};
    for (std::size_t which = 0; which < directions.size(); ++which) {
      SCOPED_TRACE(std::to_string(n) + ", direction " + std::to_string(which));
      Random random(which);
      VoxelSet standing(n);
      for (int v = 0; v < n * n; ++v)
        standing.insert({static_cast<int>(random.next() % static_cast<unsigned>(n)),
                         static_cast<int>(random.next() % static_cast<unsigned>(n)),
                         static_cast<int>(random.next() % static_cast<unsigned>(n))});
      const ToolFrame frame(directions[which]);
      const Vec3 low = grid.origin_m, high = low + Vec3::Constant(0.08);
      const HeightMap map = heights_of(standing, grid, frame, lattice_over(frame, low, high, 0.001, 0.0015), helpers);
      EXPECT_EQ(heights_of(standing, grid, frame, map.lattice, Helpers(1)).heights, map.heights);
      for_each_voxel(standing, [&](Voxel v) {
        for (int corner = 0; corner < 8; ++corner) {
          const Vec3 off((corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2) - 0.5);
          const Vec3 at = frame.of(grid.centre(v) + off * grid.voxel_m * 0.999);
          EXPECT_GE(static_cast<double>(map.at(map.lattice.cell_u(at.x()), map.lattice.cell_v(at.y()))), at.z() - 1e-7);
        }
      });
    }
  }
}

TEST(HeightMap, ASegmentsCellsAreAllThere) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Lattice lattice{-0.03, -0.02, 0.0011, 50, 40};
    const auto place = [&] { return Vec3(random.between(-0.04, 0.04), random.between(-0.03, 0.03), 0); };
    const Vec3 from = place(), to = seed % 4 == 0 ? Vec3(from + Vec3(0, random.between(-0.02, 0.02), 0)) : place();
    const double margin = seed % 2 == 0 ? 0 : random.between(0, 0.003);
    std::set<std::pair<int, int>> cells;
    for_each_cell_near(lattice, from, to, margin, [&](int a, int b) { cells.insert({a, b}); });
    for (int n = 0; n <= 1000; ++n) {
      const double turn = random.between(0, 6.3), out = margin * 0.999 * random.unit();
      const Vec3 at = from + (to - from) * (n / 1000.0) + out * Vec3(std::cos(turn), std::sin(turn), 0);
      const int a = lattice.cell_u(at.x()), b = lattice.cell_v(at.y());
      if (lattice.contains(a, b)) {
        EXPECT_TRUE(cells.contains({a, b}));
      }
    }
  }
}

TEST(HeightMap, ASegmentOnABorderOfCellsHasCells) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Lattice lattice{random.between(-0.03, -0.02), random.between(-0.03, -0.02), 0.0004, 50, 40};
    for (int b = 1; b < lattice.height; ++b) {
      const double v = lattice.low_v + b * lattice.step;
      // As far beside the border as sums round.
      for (const double at : {v, std::nextafter(v, -1), std::nextafter(v, 1)}) {
        const Vec3 from(lattice.u(5), at, 0), to(lattice.u(9), at, 0);
        std::set<int> columns;
        for_each_cell_near(lattice, from, to, 0, [&](int a, int) { columns.insert(a); });
        EXPECT_TRUE(columns.contains(5) && columns.contains(7) && columns.contains(9)) << b;
      }
    }
  }
}

}  // namespace
}  // namespace sculpt
