#include "core/mill/finish/facet_columns.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

constexpr double radius = 0.3;

Mesh make_soup(Random& random, int triangles) {
  Mesh mesh;
  for (int t = 0; t < triangles; ++t) {
    const Vec3 middle(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    for (int corner = 0; corner < 3; ++corner)
      mesh.vertices.push_back(middle +
                              Vec3(random.between(-0.4, 0.4), random.between(-0.4, 0.4), random.between(-0.4, 0.4)));
    const auto first = static_cast<std::uint32_t>(3 * t);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// Points all over the triangles, corners and edges as well.
std::vector<Vec3> samples_of(const Mesh& mesh, const ToolFrame& frame) {
  constexpr int along = 40;
  std::vector<Vec3> samples;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i <= along; ++i)
      for (int j = 0; i + j <= along; ++j) {
        const double x = static_cast<double>(i) / along, y = static_cast<double>(j) / along;
        samples.push_back(
            frame.of((1 - x - y) * mesh.vertices[t[0]] + x * mesh.vertices[t[1]] + y * mesh.vertices[t[2]]));
      }
  return samples;
}

/// From a point to the ball's middle and the rod's axis above it.
double distance(const Vec3& point, const Vec3& middle) {
  const Vec3 off = point - middle;
  return off.z() > 0 ? off.head<2>().norm() : off.norm();
}

TEST(FacetColumns, RestsWhereItTouchesAndNoHigher) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Mesh mesh = make_soup(random, 8);
    const ToolFrame frame({static_cast<int>(seed % 3), static_cast<int>(seed % 5) - 2, 3});
    const FacetColumns columns(mesh, frame);
    const std::vector<Vec3> samples = samples_of(mesh, frame);
    for (int trial = 0; trial < 50; ++trial) {
      const double u = random.between(-1, 1), v = random.between(-1, 1);
      const double height = columns.rest_height(u, v, radius, -9);
      double nearest = 9, lower = 9;
      for (const Vec3& sample : samples) {
        nearest = std::min(nearest, distance(sample, {u, v, height}));
        lower = std::min(lower, distance(sample, {u, v, height - 0.05}));
      }
      EXPECT_GE(nearest, radius - 1e-9);
      if (height > -9) {
        EXPECT_LT(lower, radius);
      }
      EXPECT_EQ(columns.rest_height(u, v, radius, height + 0.1), height + 0.1);
    }
  }
}

TEST(FacetColumns, IsClearJustWhereNothingIsNearer) {
  int clear = 0, touching = 0;
  for (std::uint64_t seed = 100; seed < 140; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Mesh mesh = make_soup(random, 4);
    const ToolFrame frame({static_cast<int>(seed % 3), 1, static_cast<int>(seed % 4)});
    const FacetColumns columns(mesh, frame);
    const std::vector<Vec3> samples = samples_of(mesh, frame);
    for (int trial = 0; trial < 50; ++trial) {
      const auto place = [&] { return Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 2)); };
      const Vec3 from = place(), to = trial % 5 == 0 ? Vec3(from.x(), from.y(), from.z() + 0.5) : place();
      double nearest = 9;
      for (int step = 0; step <= 50; ++step)
        for (const Vec3& sample : samples)
          nearest = std::min(nearest, distance(sample, from + (to - from) * step / 50));
      const bool is_clear = columns.is_clear(from, to, radius);
      if (is_clear) {
        EXPECT_GE(nearest, radius - 1e-9);
      }
      if (nearest > radius + 0.03) {
        EXPECT_TRUE(is_clear);
      }
      ++(is_clear ? clear : touching);
    }
  }
  EXPECT_GT(clear, 100);
  EXPECT_GT(touching, 100);
}

}  // namespace
}  // namespace sculpt
