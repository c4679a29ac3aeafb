#include "core/verify/mill/surface_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

Vec3 random_place(Random& random, double far) {
  return {random.between(-far, far), random.between(-far, far), random.between(-far, far)};
}

/// A way of a ball's middle (mm), and the axis of the tool.
struct Way {
  Vec3 axis, from, to;
};

/// Triangles (m) about as far off the way as the ball is large, on all sides; small ones among large ones.
Mesh mesh_around(const Way& way, double radius_mm, Random& random) {
  Mesh mesh;
  for (int n = 0; n < 6; ++n) {
    const Vec3 off = (radius_mm + random.between(-0.3, 0.3)) * random_place(random, 1).normalized();
    const Vec3 middle = way.from + random.between(0, 1) * (way.to - way.from) + off;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int corner = 0; corner < 3; ++corner)
      mesh.vertices.emplace_back((middle + random_place(random, n == 0 ? 3 : 0.2)) / 1000);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// From a point to what is above a straight way of a ball's middle, and on it (mm): by many places of the middle.
double to_curtain(const Vec3& point, const Way& way) {
  double least = HUGE_VAL;
  constexpr int places = 200;
  for (int place = 0; place <= places; ++place) {
    const Vec3 off = point - (way.from + (way.to - way.from) * place / places);
    least = std::min(least, (off - std::max(0.0, off.dot(way.axis)) * way.axis).norm());
  }
  return least;
}

TEST(SurfaceGrid, FindsHowDeepASurfaceIsInABallAndTheRodAboveIt) {
  constexpr double enough_mm = 0.2, flute_m = 0.2;
  int inside = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    const double radius_mm = random.between(1, 8);
    Way way{random_place(random, 1).normalized(), random_place(random, 25), {}};
    way.to = way.from + random_place(random, 3);
    const Mesh mesh = mesh_around(way, radius_mm, random);
    double sampled = -enough_mm;
    constexpr int steps = 16;
    for (const auto& t : mesh.triangles)
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
          const Vec3 point =
              1000 * (mesh.vertices[t[0]] * (steps - i - j) + mesh.vertices[t[1]] * i + mesh.vertices[t[2]] * j) /
              steps;
          sampled = std::max(sampled, radius_mm - to_curtain(point, way));
        }
    const Cutter cutter{CutterKind::ball, radius_mm / 1000, radius_mm / 1000, flute_m};
    const Vec3 down = -radius_mm * way.axis;
    const double depth = SurfaceGrid(mesh).depth(cutter, way.axis, way.from + down, way.to + down, enough_mm);
    EXPECT_GE(depth, sampled - 1e-9) << "seed " << seed;
    EXPECT_LE(depth, sampled + 0.25) << "seed " << seed;  // samples of a large triangle are 0.4 mm apart
    inside += sampled > -enough_mm;
  }
  EXPECT_GT(inside, 250);
}

}  // namespace
}  // namespace sculpt
