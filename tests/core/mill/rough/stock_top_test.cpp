#include "core/mill/rough/stock_top.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

constexpr double less_m = 2e-4;

Cutter random_cutter(Random& random) {
  const double radius = random.between(0.003, 0.01);
  switch (random.next() % 3) {
    case 0:
      return {CutterKind::ball, radius, radius, 0.05};
    case 1:
      return {CutterKind::flat, radius, 0, 0.05};
    default:
      return {CutterKind::bull, radius, random.between(0.1, 0.9) * radius, 0.05};
  }
}

struct Motion {
  Vec3 from, to;

  /// The lowest that a cutter which is off by `less_m` leaves of a place.
  double left_at(const Cutter& cutter, double u, double v) const {
    double lowest = HUGE_VAL;
    for (int step = 0; step <= 2000; ++step) {
      const Vec3 tip = from + (to - from) * (step / 2000.0);
      const double r = std::hypot(u - tip.x(), v - tip.y());
      if (r <= cutter.radius_m - less_m) lowest = std::min(lowest, tip.z() + less_m + cutter.height_m(r + less_m));
    }
    return lowest;
  }
};

class StockTopOfChance : public testing::TestWithParam<int> {
 protected:
  StockTopOfChance() {
    for (float& height : stands_.heights) height = static_cast<float>(random_.between(0, 0.02));
    const auto place = [&] {
      return Vec3(random_.between(-0.005, 0.045), random_.between(-0.005, 0.03), random_.between(0, 0.015));
    };
    motion_ = {place(), place()};
    if (GetParam() % 3 > 0) motion_.to.z() = motion_.from.z();
    if (GetParam() % 7 == 0) motion_.to = motion_.from;
  }

  Random random_{static_cast<std::uint64_t>(GetParam())};
  const Cutter cutter_ = random_cutter(random_);
  HeightMap stands_{Lattice{0, 0, 5e-4, 80, 50}};
  Motion motion_;
};

TEST_P(StockTopOfChance, WhatIsCutIsWhatWasToldAndNowhereTooMuch) {
  StockTop top(stands_, cutter_, less_m);
  const double told_m3 = top.volume(motion_.from, motion_.to), cut_m3 = top.cut(motion_.from, motion_.to);
  EXPECT_EQ(told_m3, cut_m3);
  EXPECT_EQ(top.volume(motion_.from, motion_.to), 0) << "it is gone";
  const Lattice& cells = stands_.lattice;
  double gone_m3 = 0;
  for (int b = 0; b < cells.height; ++b)
    for (int a = 0; a < cells.width; ++a) {
      const auto before = static_cast<double>(stands_.at(a, b)), now = static_cast<double>(top.map().at(a, b));
      ASSERT_LE(now, before);
      gone_m3 += (before - now) * cells.step * cells.step;
      if (now == before) continue;
      for (int corner = 0; corner < 4; ++corner) {
        const double u = cells.u(a) + (corner % 2 - 0.5) * cells.step, v = cells.v(b) + (corner / 2 - 0.5) * cells.step;
        ASSERT_GE(now, motion_.left_at(cutter_, u, v) - 1e-5) << a << " " << b;
      }
    }
  EXPECT_NEAR(cut_m3, gone_m3, 1e-5 * gone_m3 + 1e-15);
}

TEST_P(StockTopOfChance, OnALevelAllIsCutThatIsCoveredByMoreThanACell) {
  if (motion_.from.z() != motion_.to.z()) motion_.to.z() = motion_.from.z();
  StockTop top(stands_, cutter_, less_m);
  top.cut(motion_.from, motion_.to);
  const Lattice& cells = stands_.lattice;
  const double to_corner = cells.step / std::numbers::sqrt2;
  for (int b = 0; b < cells.height; ++b)
    for (int a = 0; a < cells.width; ++a) {
      double r = HUGE_VAL;
      for (int step = 0; step <= 2000; ++step) {
        const Vec3 tip = motion_.from + (motion_.to - motion_.from) * (step / 2000.0);
        r = std::min(r, std::hypot(cells.u(a) - tip.x(), cells.v(b) - tip.y()));
      }
      r += to_corner;
      if (r > cutter_.radius_m - less_m - 1e-6) continue;
      const double left = motion_.from.z() + less_m + cutter_.height_m(r + less_m);
      ASSERT_NEAR(static_cast<double>(top.map().at(a, b)), std::min(left, static_cast<double>(stands_.at(a, b))), 1e-5)
          << a << " " << b;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, StockTopOfChance, testing::Range(0, 40));

TEST(StockTop, ACutterNoWiderThanACellCutsNothing) {
  HeightMap stands(Lattice{0, 0, 1e-3, 10, 10});
  for (float& height : stands.heights) height = 0.01F;
  StockTop top(stands, {CutterKind::flat, 6e-4, 0, 0.05}, 0);
  EXPECT_EQ(top.cut({0.0005, 0.0005, 0}, {0.0095, 0.0005, 0}), 0);
  EXPECT_EQ(top.map().heights, stands.heights);
}

TEST(StockTop, BesideTheLatticeNothingIsCut) {
  HeightMap stands(Lattice{0, 0, 1e-3, 10, 10});
  for (float& height : stands.heights) height = 0.01F;
  StockTop top(stands, {CutterKind::ball, 0.003, 0.003, 0.05}, 0);
  for (const Vec3& far : {Vec3(-1, 0.005, 0), Vec3(1, 0.005, 0), Vec3(0.005, -1, 0), Vec3(0.005, 1, 0)})
    EXPECT_EQ(top.volume(far, far), 0);
}

}  // namespace
}  // namespace sculpt
