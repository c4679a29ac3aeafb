#include "core/mill/finish/tour/contour_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "tests/core/mill/finish/quads.hpp"

namespace sculpt {
namespace {

constexpr double radius = 3e-3, allowance = 3e-5, step = 7e-4;

/// A ball over a roof of some width, its ridge along y.
class OverARoof : public ::testing::Test {
 protected:
  Contour line(double x, double y) const {
    auto contours = follow_envelope(task, frame.of({-0.009, -0.004, 0}).head<2>(), frame.of({x, y, 0}).head<2>());
    EXPECT_EQ(contours.size(), 1U);
    return contours.at(0);
  }

  double off_rest_m(const Vec3& tip) const {
    return std::abs(tip.z() + radius - columns.rest_height(tip.x(), tip.y(), radius + allowance, -0.1));
  }

  const Mesh mesh = quads({{Vec3(-0.02, -0.02, 0), Vec3(0, -0.02, 0.01), Vec3(0, 0.02, 0.01), Vec3(-0.02, 0.02, 0)},
                           {Vec3(0, -0.02, 0.01), Vec3(0.02, -0.02, 0), Vec3(0.02, 0.02, 0), Vec3(0, 0.02, 0.01)}});
  const ToolFrame frame = ToolFrame({0, 0, 1});
  const FacetColumns columns = FacetColumns(mesh, frame);
  const EnvelopeTask task = {
      columns, radius, allowance, 2.1e-5, 2e-5, -0.1, [](const Vec3&, const Vec3&) { return true; }};
};

TEST_F(OverARoof, StepsAreNoLongerThanAskedForAndKeepTheCorners) {
  const Contour contour = line(0.011, 0.007);
  const ContourSteps steps = in_steps(contour, step);
  ASSERT_EQ(steps.corners.size(), contour.size());
  for (std::size_t corner = 0; corner < contour.size(); ++corner)
    EXPECT_EQ(steps.places[steps.corners[corner]], contour[corner]);
  for (std::size_t place = 1; place < steps.places.size(); ++place)
    EXPECT_LE((steps.places[place] - steps.places[place - 1]).norm(), step * (1 + 1e-9));
  EXPECT_NEAR(length_m(steps.places), length_m(contour), 1e-12);
}

TEST_F(OverARoof, AllOfItIsTheContour) {
  const Contour contour = line(0.011, 0.007);
  const ContourSteps steps = in_steps(contour, step);
  EXPECT_EQ(part_of(steps, {0, steps.places.size() - 1}, task), contour);
}

TEST_F(OverARoof, APartIsAtRestWhereItBeginsAndEnds) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const ContourSteps steps = in_steps(line(random.between(0.001, 0.012), random.between(-0.01, 0.01)), step);
    const auto places = static_cast<double>(steps.places.size());
    const auto first = static_cast<std::size_t>(random.between(0, places - 1));
    const auto last = first + 1 + static_cast<std::size_t>(random.between(0, places - 1 - static_cast<double>(first)));
    const Contour part = part_of(steps, {first, last}, task);
    ASSERT_GE(part.size(), 2U);
    EXPECT_LT((part.front() - steps.places[first]).head<2>().norm(), 1e-9);
    EXPECT_LT((part.back() - steps.places[last]).head<2>().norm(), 1e-9);
    for (const Vec3& tip : part) EXPECT_LT(off_rest_m(tip), 1e-6);
    double length = 0;
    for (std::size_t place = first; place < last; ++place)
      length += (steps.places[place + 1] - steps.places[place]).norm();
    EXPECT_LT(length_m(part), 1.01 * length + 2e-5);
    for (std::size_t edge = 0; edge + 1 < part.size(); ++edge) {
      const Vec3 up(0, 0, radius);
      EXPECT_TRUE(columns.is_clear(part[edge] + up, part[edge + 1] + up, radius + task.clear_m));
    }
  }
}

TEST_F(OverARoof, WhereNoRestIsFoundItIsLongerThanAskedFor) {
  const Contour contour = line(0.011, 0.007);
  const ContourSteps steps = in_steps(contour, step);
  EnvelopeTask forbidden = task;
  forbidden.is_allowed = [](const Vec3&, const Vec3&) { return false; };
  EXPECT_EQ(part_of(steps, {1, steps.places.size() - 2}, forbidden), contour);
}

}  // namespace
}  // namespace sculpt
