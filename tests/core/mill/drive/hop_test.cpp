#include "core/mill/drive/hop.hpp"

#include <gtest/gtest.h>

#include "tests/core/mill/map/rubble_site.hpp"

namespace sculpt {
namespace {

constexpr double stray = 2e-5;

/// From where nothing is in the way above; the tip is `deep` lower than that.
Vec3 in_the_rubble(const RubbleSite& rubble, Random& random, double deep) {
  Vec3 tip = rubble.some_place(random);
  tip.z() = rubble.site().free_height(tip, 0) - deep;
  return tip;
}

struct Lengths {
  double cut = 0, near = 0, over = 0;
};

/// Goes over and looks at all of it.
void go_over(Random& random, bool is_ball, Lengths& lengths) {
  const RubbleSite rubble(random, some_cutter(random, is_ball), {0, 0, 1});
  const Vec3 from = in_the_rubble(rubble, random, 1e-3), to = in_the_rubble(rubble, random, 2e-3);
  if (from.z() < -1 || to.z() < -1) return;
  std::vector<MillStroke> strokes;
  hop(rubble.site(), from, to, is_ball ? 0.05 : -1, stray, strokes);
  ASSERT_FALSE(strokes.empty());
  Vec3 at = from;
  for (const MillStroke& stroke : strokes) {
    const Vec3 begin = at, way = rubble.site().frame().of(stroke.tip_m) - at;
    at += way;
    EXPECT_TRUE(way.head<2>().isZero(1e-12) || std::abs(way.z()) < 1e-12);
    (stroke.cut ? lengths.cut : stroke.stray_m == stray ? lengths.near : lengths.over) += way.norm();
    EXPECT_TRUE(!stroke.cut || stroke.stray_m == stray);
    for (double share = 0; share <= 1 && !stroke.cut; share += 0.1)
      EXPECT_GT(rubble.room_m(begin + share * way), stroke.stray_m);
  }
  EXPECT_LT((at - to).norm(), 1e-12);
}

TEST(Hop, TouchesNothingButWhereItMayCut) {
  Lengths lengths;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    go_over(random, seed % 2 == 0, lengths);
  }
  // No more of it is led as a cut than where something may stand beside.
  EXPECT_GT(lengths.cut, 0.06);
  EXPECT_LT(lengths.cut, 0.4);
  EXPECT_GT(lengths.near, 0.2);
  EXPECT_GT(lengths.over, 0.6);
}

}  // namespace
}  // namespace sculpt
