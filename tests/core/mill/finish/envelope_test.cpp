#include "core/mill/finish/envelope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/mill/finish/quads.hpp"

namespace sculpt {
namespace {

constexpr double radius = 3e-3, allowance = 3e-5, clear = 2.1e-5, chord = 2e-5;

EnvelopeTask make_task(const FacetColumns& columns) {
  return {columns, radius, allowance, clear, chord, -0.1, [](const Vec3&, const Vec3&) { return true; }};
}

/// A groove of 90 degrees along y, its crease at the origin.
Mesh groove() {
  const double w = 0.02;
  return quads({{Vec3(-w, -w, w), Vec3(0, -w, 0), Vec3(0, w, 0), Vec3(-w, w, w)},
                {Vec3(0, -w, 0), Vec3(w, -w, w), Vec3(w, w, w), Vec3(0, w, 0)}});
}

TEST(Envelope, GoesDownIntoAGrooveAsFarAsTheBallFits) {
  const Mesh mesh = groove();
  const ToolFrame frame({0, 0, 1});
  const FacetColumns columns(mesh, frame);
  // Whatever u and v are called: across the groove.
  const Vec3 from = frame.of({-0.012, 0, 0}), to = frame.of({0.012, 0, 0});
  const auto contours = follow_envelope(make_task(columns), from.head<2>(), to.head<2>());
  ASSERT_EQ(contours.size(), 1U);
  double lowest = 1;
  for (const Vec3& tip : contours[0]) lowest = std::min(lowest, tip.z());
  // The crease keeps R (sqrt 2 - 1), and the allowance.
  EXPECT_NEAR(lowest, (radius + allowance) * std::numbers::sqrt2 - radius, 2e-5);
  EXPECT_LT(contours[0].size(), 40U);
}

constexpr double wall_m = 0.02;

/// Along y, its foot at the origin.
Mesh wall() {
  const double w = 0.03;
  return quads({{Vec3(-w, -w, wall_m), Vec3(0, -w, wall_m), Vec3(0, w, wall_m), Vec3(-w, w, wall_m)},
                {Vec3(0, -w, wall_m), Vec3(0, -w, 0), Vec3(0, w, 0), Vec3(0, w, wall_m)},
                {Vec3(0, -w, 0), Vec3(w, -w, 0), Vec3(w, w, 0), Vec3(0, w, 0)}});
}

TEST(Envelope, GoesDownAnUprightWall) {
  const Mesh mesh = wall();
  const ToolFrame frame({0, 0, 1});
  const FacetColumns columns(mesh, frame);
  const Vec3 from = frame.of({-0.01, 0, 0}), to = frame.of({0.01, 0, 0});
  const auto contours = follow_envelope(make_task(columns), from.head<2>(), to.head<2>());
  ASSERT_EQ(contours.size(), 1U);
  // Some edge goes down the wall at just the radius from it.
  double longest = 0;
  for (std::size_t at = 1; at < contours[0].size(); ++at) {
    const Vec3 a = frame.point(contours[0][at - 1]), b = frame.point(contours[0][at]);
    if (std::abs(a.x() - radius) < 2 * allowance && std::abs(b.x() - radius) < 2 * allowance)
      longest = std::max(longest, std::abs(a.z() - b.z()));
  }
  EXPECT_GT(longest, 0.012);
}

/// How low the tip comes on ways over the wall, from both sides and wherever looks fall beside it, where it may not be
/// lower than `floor_m` and balls rest beside the wall at these heights.
std::vector<double> lowest_beside_wall(double floor_m, const std::vector<double>& stops_m) {
  const Mesh mesh = wall();
  const ToolFrame frame({0, 0, 1});
  const FacetColumns columns(mesh, frame);
  EnvelopeTask task = make_task(columns);
  task.is_allowed = [&](const Vec3& a, const Vec3& b) { return std::min(a.z(), b.z()) >= floor_m; };
  std::vector<double> lowest;
  for (double shift = 0; shift < 1e-3; shift += 1e-4)
    for (const double way : {1.0, -1.0}) {
      const double begin = shift - 0.01 * way, end = shift + 0.01 * way;
      std::vector<WallStop> stops;
      for (const double height : stops_m) stops.push_back({(radius - begin) * way, height});
      const auto contours =
          follow_envelope(task, frame.of({begin, 0, 0}).head<2>(), frame.of({end, 0, 0}).head<2>(), stops);
      EXPECT_EQ(contours.size(), 1U);
      lowest.push_back(1);
      for (const Vec3& tip : contours.at(0)) lowest.back() = std::min(lowest.back(), tip.z());
    }
  return lowest;
}

TEST(Envelope, GoesDownAWallAsLowAsTheStopsBesideIt) {
  for (const double low : lowest_beside_wall(0.005, {0.012, 0.018})) EXPECT_DOUBLE_EQ(low, 0.012);
  for (const double low : lowest_beside_wall(0.009, {0.004, 0.012, 0.018})) EXPECT_NEAR(low, 0.009, 5e-4);
  for (const double low : lowest_beside_wall(0.005, {})) EXPECT_GT(low, wall_m - radius);
}

TEST(Envelope, BreaksOffWhereItMayNotGo) {
  const Mesh mesh = groove();
  const ToolFrame frame({0, 0, 1});
  const FacetColumns columns(mesh, frame);
  EnvelopeTask task = make_task(columns);
  task.is_allowed = [&](const Vec3& a, const Vec3& b) {
    return std::min(frame.point(a).z(), frame.point(b).z()) > 0.004;
  };
  const Vec3 from = frame.of({-0.012, 0, 0}), to = frame.of({0.012, 0, 0});
  const auto contours = follow_envelope(task, from.head<2>(), to.head<2>());
  ASSERT_EQ(contours.size(), 2U);
  for (const Contour& contour : contours)
    for (const Vec3& tip : contour) EXPECT_GT(tip.z(), 0.004);
}

TEST(Envelope, AsAWholeIsPulledTightOrNothing) {
  const Mesh mesh = groove();
  const ToolFrame frame({0, 0, 1});
  const FacetColumns columns(mesh, frame);
  EnvelopeTask task = make_task(columns);
  const Vec3 from = frame.of({-0.012, 0, 0}), to = frame.of({0.012, 0, 0});
  const auto whole = [&](double max_m) { return follow_whole(task, from.head<2>(), to.head<2>(), max_m); };
  const auto pieces = follow_envelope(task, from.head<2>(), to.head<2>());
  ASSERT_EQ(pieces.size(), 1U);
  double length = 0;
  for (std::size_t at = 1; at < pieces[0].size(); ++at) length += (pieces[0][at] - pieces[0][at - 1]).norm();
  EXPECT_EQ(whole(1.01 * length), (Contour{pieces[0].front(), pieces[0].back()}));  // over the groove
  EXPECT_TRUE(whole(0.99 * length).empty());
  task.is_allowed = [&](const Vec3& a, const Vec3&) { return frame.point(a).z() > 0.004; };
  EXPECT_TRUE(whole(1).empty());
  // A wall that no look falls on, but that edges do.
  task.is_allowed = [&](const Vec3& a, const Vec3& b) {
    return (frame.point(a).x() > 1e-5) == (frame.point(b).x() > 1e-5);
  };
  EXPECT_GT(follow_envelope(task, from.head<2>(), to.head<2>()).size(), 1U);
  EXPECT_TRUE(whole(1).empty());
}

}  // namespace
}  // namespace sculpt
