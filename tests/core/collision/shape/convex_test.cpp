#include "core/collision/shape/convex.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/base/cases.hpp"
#include "tests/core/collision/shape/random_shapes.hpp"

namespace sculpt {
namespace {

constexpr double tiny = 1e-9;

TEST(Convex, ThePlaneOfASeparationLiesBetweenAllPointsOfTheTwo) {
  int apart = 0;
  for (std::uint64_t seed = 0; seed < cases(3000u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Convex first = random_convex(random), second = random_convex(random);
    for (const Effort effort : {Effort::rough, Effort::full}) {
      const Separation plane = separate(first, second, random.between(0, 1), effort);
      ASSERT_NEAR(plane.normal.norm(), 1, tiny);
      apart += plane.gap > 0;
      for (int sample = 0; sample < 40; ++sample) {
        ASSERT_GE(plane.normal.dot(random_point_of(first, random)), plane.second_to + plane.gap - tiny);
        ASSERT_LE(plane.normal.dot(random_point_of(second, random)), plane.second_to + tiny);
      }
    }
  }
  EXPECT_GT(apart, cases(1000));
}

TEST(Convex, ShapesThatAreApartAreSeparatedByNearlyAllOfTheirDistance) {
  int compared = 0;
  for (std::uint64_t seed = 0; seed < cases(3000u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Convex first = random_convex(random), second = random_convex(random);
    const double distance = slow_distance(first, second);
    const double gap = separate(first, second, 10, Effort::full).gap;
    ASSERT_LE(gap, distance + 1e-6);
    if (distance < 3e-3) continue;
    ++compared;
    ASSERT_GE(gap, 0.8 * distance - 1e-3);
  }
  EXPECT_GT(compared, cases(1000));
}

TEST(Convex, NoPointOfAShapeIsBeyondItsCornersOrItsExtent) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Convex shape = random_convex(random);
    const Convex::Corners corners = shape.corners();
    for (int sample = 0; sample < 20; ++sample) {
      const Vec3 point = random_point_of(shape, random), along = random_direction(random);
      double farthest = std::numeric_limits<double>::lowest();
      for (std::size_t at = 0; at < corners.count; ++at)
        farthest = std::max(farthest, along.dot(corners.points[at]) + corners.radius);
      EXPECT_LE(along.dot(point), farthest + tiny);
      EXPECT_LE((point - shape.centre()).norm(), shape.extent() + tiny);
    }
  }
}

TEST(Convex, APlacedShapeIsTheSameElsewhere) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Convex first = random_convex(random), second = random_convex(random);
    const Frame pose = random_pose(random);
    EXPECT_NEAR(separate(first, second, 10, Effort::full).gap,
                separate(first.placed(pose), second.placed(pose), 10, Effort::full).gap, 1e-3);
  }
}

}  // namespace
}  // namespace sculpt
