#include "core/mill/finish/contour_strokes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/core/mill/finish/quads.hpp"

namespace sculpt {
namespace {

constexpr double edge = 0.064, radius = 3e-3, allowance = 3e-5, rest = edge / 2 + allowance;

/// A ball at rest on a slab, where something keeps the body high between two planes across x.
class OnASlab : public ::testing::Test {
 protected:
  /// Along x; `height`: no tip may be lower in the middle.
  Contour way(double from, double to, double height) {
    envelope.is_allowed = [&](const Vec3& a, const Vec3& b) {
      const auto [low, high] = std::minmax({frame.point(a).x(), frame.point(b).x()});
      return high < middle - width / 2 || low > middle + width / 2 || std::min(a.z(), b.z()) >= height;
    };
    const double anything = -std::numeric_limits<double>::infinity();
    const ContourStrokes strokes({site, envelope, tool, swept, edge / 32, 2e-5, 0.05, anything},
                                 SweptSet(VoxelSet(32), slab.grid), at(from));
    return strokes.way_to(at(to));
  }

  /// The tip at rest (tool frame).
  Vec3 at(double x) const { return frame.of({x, edge / 2, rest}); }

  static constexpr double middle = edge / 2, width = 2e-3;
  const PartInGrid slab = make_slab(edge);
  const ToolFrame frame = ToolFrame({0, 0, 1});
  const MillTool tool = {"D6", 1, {CutterKind::ball, radius, radius, 0.02}, {}, 0.1, radius, radius, 0.05, {}, {}};
  const Site site = {frame,
                     lattice_over(frame, Vec3::Zero(), Vec3::Constant(edge), 0.01, 1e-3),
                     {tool, {}, 0.1},
                     slab.mesh,
                     {},
                     {allowance, 1e-4}};
  const SweptCutter swept = {tool.cutter, {0, 0, 1}, 2e-5};
  const FacetColumns columns = FacetColumns(slab.mesh, frame);
  EnvelopeTask envelope = {columns, radius, allowance, 2.1e-5, 2e-5, -0.1, {}};
};

TEST_F(OnASlab, WhereNothingIsInTheWayItStaysOnTheSurface) {
  const Contour along = way(0.025, 0.036, 0);
  ASSERT_GE(along.size(), 2U);
  for (const Vec3& tip : along) EXPECT_NEAR(tip.z(), rest, 1e-6);
}

TEST_F(OnASlab, ItIsRaisedNoMoreThanItMust) {
  const Contour over = way(0.028, 0.036, rest + 4e-3);
  ASSERT_EQ(over.size(), 4U);
  EXPECT_EQ(over.front(), at(0.028));
  EXPECT_EQ(over.back(), at(0.036));
  EXPECT_GE(over[1].z(), rest + 4e-3);
  EXPECT_LT(over[1].z(), rest + 4e-3 + radius / 4 + 1e-9);
  EXPECT_EQ(over[1].z(), over[2].z());
}

TEST_F(OnASlab, NotWhereThatIsFar) {
  EXPECT_TRUE(way(0.028, 0.036, rest + 9e-3).empty());
  EXPECT_TRUE(way(0.015, 0.050, rest + 1e-3).empty());
}

/// A rib across the way, higher than the depth of cut: too much at once.
TEST_F(OnASlab, WhatIsTooMuchAtOnceIsCutInLayers) {
  MillTool big = tool;
  big.cutter = {CutterKind::ball, 2 * radius, 2 * radius, 0.02};
  big.max_depth_m = big.max_width_m = 2 * radius;
  const SweptCutter big_swept(big.cutter, {0, 0, 1}, 2e-5);
  VoxelSet rib(32);
  for (int i = 14; i < 22; ++i)
    for (int j = 0; j < 32; ++j)
      for (int k = 16; k < 20; ++k) rib.insert({i, j, k});
  const double voxel_m = edge / 32;
  const auto quanta = [&](const Vec3& tip) { return quanta_of(frame.point(tip)); };
  Contour contour;
  for (int mm = 18; mm <= 52; ++mm) contour.push_back(at(mm / 1000.0));

  SweptSet at_once(rib, slab.grid);
  const std::uint32_t all = at_once.take(big_swept, quanta(contour.front()), quanta(contour.back()));
  EXPECT_FALSE(counted_load(big, voxel_m).bears(all * std::pow(voxel_m, 3), 0.016));

  ContourStrokes laid({site, envelope, big, big_swept, voxel_m, 2e-5, 0.05, rest}, SweptSet(rib, slab.grid), at(0.01));
  laid.lay(contour, {}, {});
  EXPECT_TRUE(laid.is_down());
  EXPECT_EQ(laid.at(), contour.back());
  SweptSet left(rib, slab.grid);
  ChipLoad load = counted_load(big, voxel_m);
  Vec3 tip = at(0.01);
  double highest = 0;
  for (const MillStroke& stroke : laid.strokes()) {
    const Vec3 to = frame.of(stroke.tip_m);
    if (stroke.cut) {
      const std::uint32_t voxels = left.take(big_swept, quanta(tip), quanta(to));
      EXPECT_TRUE(load.bears(voxels * std::pow(voxel_m, 3), (to - tip).norm()));
      if (stroke.tip_m.x() > 0.02) highest = std::max(highest, to.z());
    }
    tip = to;
  }
  EXPECT_GT(highest, rest + 0.2 * big.max_depth_m);
  EXPECT_EQ(left.voxels().size(), at_once.voxels().size()) << "as much as at once";
}

}  // namespace
}  // namespace sculpt
