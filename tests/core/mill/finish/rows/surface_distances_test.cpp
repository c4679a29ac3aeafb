#include "core/mill/finish/rows/surface_distances.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace sculpt {
namespace {

constexpr double step = 0.01;
constexpr int cells = 120;

/// A square lattice around the origin.
PlanPatch make_patch(const std::function<bool(const Point2&)>& is_inside, const Point2& slope) {
  const double low = -0.5 * cells * step;
  PlanPatch patch{{low, low, step, cells, cells}, {}, {}};
  for (int b = 0; b < cells; ++b)
    for (int a = 0; a < cells; ++a) {
      const bool is_border = a == 0 || b == 0 || a + 1 == cells || b + 1 == cells;
      patch.is_inside.push_back(!is_border && is_inside({patch.lattice.u(a), patch.lattice.v(b)}));
      patch.slopes.push_back(slope);
    }
  return patch;
}

std::vector<float> distances_to_border(const PlanPatch& patch) {
  std::vector<char> is_outside;
  for (const char is_inside : patch.is_inside) is_outside.push_back(is_inside == 0);
  return surface_distances(patch, is_outside);
}

TEST(SurfaceDistances, OfADiscAreThoseToItsEdge) {
  const double radius = 0.5;
  const PlanPatch disc = make_patch([&](const Point2& at) { return at.norm() < radius; }, Point2::Zero());
  const std::vector<float> distances = distances_to_border(disc);
  for (int b = 0; b < cells; ++b)
    for (int a = 0; a < cells; ++a) {
      const double far = radius - Point2(disc.lattice.u(a), disc.lattice.v(b)).norm();
      if (far < 0)
        EXPECT_EQ(distances[disc.lattice.index(a, b)], 0);
      else
        EXPECT_NEAR(distances[disc.lattice.index(a, b)], far, 1.5 * step) << a << ' ' << b;
    }
}

TEST(SurfaceDistances, AcrossAStripGrowWithItsSlopeHoweverItLies) {
  const double half_width = 0.2;
  for (const double slope : {0.0, 0.5, 1.0, 2.5})
    for (int turn = 0; turn < 12; ++turn) {
      SCOPED_TRACE(testing::Message() << "slope " << slope << " turn " << turn);
      const double angle = turn * 0.2618;
      const Point2 across(std::cos(angle), std::sin(angle));
      // It rises across itself; then along itself, which makes it no wider.
      for (const bool rises_across : {true, false}) {
        const Point2 gradient = slope * (rises_across ? across : Point2(-across.y(), across.x()));
        const PlanPatch strip =
            make_patch([&](const Point2& at) { return std::abs(at.dot(across)) < half_width; }, gradient);
        const std::vector<float> distances = distances_to_border(strip);
        const double expected = half_width * (rises_across ? std::hypot(1.0, slope) : 1);
        const float middle = distances[strip.lattice.index(cells / 2, cells / 2)];
        EXPECT_NEAR(middle, expected, 2 * step * std::hypot(1.0, slope));
      }
    }
}

TEST(SurfaceDistances, OfNothingAreNone) {
  EXPECT_TRUE(distances_to_border({}).empty());
}

}  // namespace
}  // namespace sculpt
