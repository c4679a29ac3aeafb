#include "core/mill/map/offset_map.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

Cutter cutter_of(CutterKind kind, double radius_m, double corner_m) {
  return {kind, radius_m, kind == CutterKind::ball ? radius_m : corner_m, 0.05};
}

/// Points anywhere, with the heights of the map that holds them.
struct Rubble {
  std::vector<Vec3> points;
  HeightMap map;
};

Rubble make_rubble(Random& random, int count) {
  Rubble rubble{{}, HeightMap(Lattice{-0.05, -0.04, 0.0013, 80, 64})};
  for (int n = 0; n < count; ++n) {
    const Vec3 at(random.between(-0.05, 0.05), random.between(-0.04, 0.04), random.between(-0.03, 0.03));
    rubble.points.push_back(at);
    rubble.map.raise(at, at + Vec3(1e-7, 0, 0), at + Vec3(0, 1e-7, 0));
  }
  return rubble;
}

TEST(OffsetMap, NoPointIsInsideACutterThatItLetsStand) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Rubble rubble = make_rubble(random, 40);
    const double more_m = random.between(0, 0.001);
    const Cutter cutter =
        cutter_of(static_cast<CutterKind>(seed % 3), random.between(0.002, 0.012), seed % 3 == 1 ? 0.001 : 0);
    const HeightMap limit = offset_by_cutter(rubble.map, cutter, more_m);
    double min_room = 1;
    for (int n = 0; n < 3000; ++n) {
      const double u = random.between(-0.045, 0.045), v = random.between(-0.035, 0.035);
      const float lowest = limit.at(limit.lattice.cell_u(u), limit.lattice.cell_v(v));
      if (lowest == no_height) continue;
      for (const Vec3& point : rubble.points) {
        const double r = std::hypot(point.x() - u, point.y() - v);
        if (r > cutter.radius_m) continue;
        const double room = lowest + cutter.height_m(r) - point.z();
        min_room = std::min(min_room, room);
        EXPECT_GE(room, more_m - 1e-7);
      }
    }
    EXPECT_LT(min_room, 0.02);  // and it is not just high everywhere
  }
}

TEST(OffsetMap, ABallComesDownToAPlaneAndToAStepAsItShould) {
  HeightMap floor(Lattice{-0.05, -0.05, 0.001, 100, 100});
  for (int b = 0; b < 100; ++b)
    for (int a = 0; a < 100; ++a) floor.raise(a, b, a < 50 ? 0.0F : 0.02F);
  const Cutter ball = cutter_of(CutterKind::ball, 0.01, 0);
  const HeightMap limit = offset_by_cutter(floor, ball, 0);
  EXPECT_NEAR(limit.at(20, 50), 0, 1e-6);
  EXPECT_NEAR(limit.at(80, 50), 0.02, 1e-6);
  // 5 mm before a wall of 20 mm: the ball touches its edge at a height of R - sqrt(R^2 - 5^2), a cell nearer at most.
  EXPECT_LE(limit.at(45, 50), 0.02 - ball.height_m(0.003) + 1e-6);
  EXPECT_GE(limit.at(45, 50), 0.02 - ball.height_m(0.005) - 1e-6);
  EXPECT_NEAR(limit.at(38, 50), 0, 1e-6);
}

TEST(OffsetMap, RingsAreDiscs) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Rubble rubble = make_rubble(random, 30);
    const std::vector<Ring> rings{{random.between(0.001, 0.005), 0.01}, {random.between(0.008, 0.025), 0.02}};
    const HeightMap limit = offset_by_rings(rubble.map, rings, 0.0005);
    // Brute force over the cells.
    const Lattice& lattice = limit.lattice;
    for (int n = 0; n < 400; ++n) {
      const int a = static_cast<int>(random.next() % 80), b = static_cast<int>(random.next() % 64);
      double wanted = -1;
      for (int d = 0; d < lattice.height; ++d)
        for (int c = 0; c < lattice.width; ++c)
          for (const Ring& ring : rings) {
            const double r =
                lattice.step * std::hypot(std::max(0, std::abs(c - a) - 1), std::max(0, std::abs(d - b) - 1));
            if (r <= ring.radius_m + 0.0005 && rubble.map.at(c, d) != no_height)
              wanted = std::max(wanted, static_cast<double>(rubble.map.at(c, d)) - ring.height_m + 0.0005);
          }
      // Wide rings are looked at on coarser cells: never lower, and as high somewhere near.
      if (wanted != -1) {
        EXPECT_GE(static_cast<double>(limit.at(a, b)), wanted - 1e-7);
      }
    }
  }
}

}  // namespace
}  // namespace sculpt
