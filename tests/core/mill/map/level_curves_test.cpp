#include "core/mill/map/level_curves.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/mill/rough/row_field.hpp"

namespace sculpt {
namespace {

RowField sampled(int cells, const std::function<double(const Point2&)>& value) {
  RowField field{{-0.05, -0.05, 0.1 / cells, cells, cells}, {}};
  for (int b = 0; b < cells; ++b)
    for (int a = 0; a < cells; ++a)
      field.values.push_back(static_cast<float>(value({field.lattice.u(a), field.lattice.v(b)})));
  return field;
}

double area_of(const Curve& ring) {
  double area = 0;
  for (std::size_t at = 0; at + 1 < ring.size(); ++at)
    area += (ring[at].x() * ring[at + 1].y() - ring[at].y() * ring[at + 1].x()) / 2;
  return area;
}

TEST(LevelCurves, OfADistanceAreCirclesWithWhatIsFartherOnTheLeft) {
  const RowField field = sampled(100, [](const Point2& p) { return (p - Point2(0.01, -0.005)).norm(); });
  const std::vector<Curve> curves = level_curves(field.values, field.lattice, 0.03);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].front(), curves[0].back());
  for (const Point2& p : curves[0]) EXPECT_NEAR((p - Point2(0.01, -0.005)).norm(), 0.03, 2e-5);
  // The middle is on the right: it is gone around clockwise.
  EXPECT_NEAR(area_of(curves[0]), -M_PI * 0.03 * 0.03, 2e-6);
}

TEST(LevelCurves, OfAnySmoothFieldLieOnItsValueAndHaveTheLargerOnTheirLeft) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    std::array<Point2, 4> waves;
    for (Point2& wave : waves) wave = Point2(random.between(-100, 100), random.between(-100, 100));
    const RowField field = sampled(60, [&](const Point2& p) {
      double sum = 0;
      for (const Point2& wave : waves) sum += std::sin(wave.dot(p));
      return sum;
    });
    for (const Curve& curve : level_curves(field.values, field.lattice, 0.3)) {
      ASSERT_GE(curve.size(), 2U);
      const bool is_ring = curve.front() == curve.back();
      for (const Point2* end : {&curve.front(), &curve.back()})
        EXPECT_TRUE(is_ring || end->cwiseAbs().maxCoeff() > 0.05 - field.lattice.step) << "seed " << seed;
      for (std::size_t at = 0; at + 1 < curve.size(); ++at) {
        EXPECT_NEAR(field.at(curve[at]), 0.3, 1e-5) << "seed " << seed;
        const Point2 way = curve[at + 1] - curve[at], left(-way.y(), way.x()), middle = (curve[at] + curve[at + 1]) / 2;
        if (way.norm() < field.lattice.step / 4) continue;
        EXPECT_GE(field.at(middle + left), field.at(middle - left)) << "seed " << seed;
      }
    }
  }
}

TEST(RowField, GrowsOutwards) {
  const RowField field = sampled(50, [](const Point2& p) { return 2 * p.x() + p.y(); });
  EXPECT_NEAR(field.at({0.0123, -0.02}), 2 * 0.0123 - 0.02, 1e-6);
  EXPECT_LT((field.outwards({0.0123, -0.02}) - Point2(2, 1).normalized()).norm(), 1e-4);
}

}  // namespace
}  // namespace sculpt
