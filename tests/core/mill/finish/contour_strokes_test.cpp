#include "core/mill/finish/contour_strokes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

}  // namespace
}  // namespace sculpt
