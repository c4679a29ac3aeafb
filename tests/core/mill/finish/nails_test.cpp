#include "core/mill/finish/nails.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/mill/finish/quads.hpp"

namespace sculpt {
namespace {

constexpr double edge = 0.02, radius = 3e-3;

TEST(Nails, StandOutwardsWhicheverWayTheFacetsAreTurned) {
  PartInGrid slab = make_slab(edge);
  for (const bool turned : {false, true}) {
    if (turned)
      for (auto& t : slab.mesh.triangles) std::swap(t[1], t[2]);
    const Nails nails(slab.mesh, slab.voxels, slab.grid, 2000, 7);
    EXPECT_EQ(nails.size(), 1500U);  // a quarter of it is what the slab stands on
    const Vec3 middle(edge / 2, edge / 2, edge / 4);
    for (std::size_t at = 0; at < nails.size(); ++at)
      EXPECT_GT(nails[at].normal.dot(nails[at].point - middle), 0) << nails[at].point.transpose();
  }
}

TEST(Nails, RowsLeaveTheScallopsOfTheirSpacing) {
  const PartInGrid slab = make_slab(edge);
  Nails nails(slab.mesh, slab.voxels, slab.grid, 5000, 8);
  const double spacing = 1e-3, off = 4e-5;
  for (double y = -2 * spacing; y < edge + 2 * spacing; y += spacing)
    nails.cut({-0.005, y, edge / 2 + radius + off}, {edge + 0.005, y, edge / 2 + radius + off}, radius);
  const double cusp = off + radius - std::sqrt(radius * radius - spacing * spacing / 4);
  double most = 0, least = 1;
  std::size_t above = 0;
  for (std::size_t at = 0; at < nails.size(); ++at) {
    if (nails[at].normal.z() < 0.5) continue;
    ++above;
    most = std::max(most, nails.excess(at));
    least = std::min(least, nails.excess(at));
  }
  EXPECT_GT(above, 1000U);
  EXPECT_NEAR(most, cusp, 1e-6);
  EXPECT_NEAR(least, off, 1e-6);
}

TEST(Nails, WhatABallDoesNotTouchStays) {
  const PartInGrid slab = make_slab(edge);
  Nails nails(slab.mesh, slab.voxels, slab.grid, 1000, 9);
  // Below the slab, and high above it.
  nails.cut({0, edge / 2, -radius - 0.002}, {edge, edge / 2, -radius - 0.002}, radius);
  nails.cut({0, edge / 2, edge + radius}, {edge, edge / 2, edge + radius}, radius);
  for (std::size_t at = 0; at < nails.size(); ++at) {
    // All but the top of the slab is on the block's sides already.
    EXPECT_EQ(nails.excess(at), nails[at].normal.z() > 0.5 ? Nails::uncut : 0.0) << nails[at].point.transpose();
  }
}

TEST(Nails, ACopyIsCutAsTheyWouldBeAndGoesBack) {
  const PartInGrid slab = make_slab(edge);
  Nails nails(slab.mesh, slab.voxels, slab.grid, 1000, 10);
  const std::vector<float> before = nails.excesses();
  std::vector<float> copy = before;
  std::vector<Nails::Change> changes;
  for (const double y : {0.3 * edge, 0.3 * edge + 1e-3, 0.5 * edge})
    nails.cut({0, y, edge / 2 + radius}, {edge, y, edge / 2 + radius}, radius, copy, changes);
  EXPECT_EQ(nails.excesses(), before);
  std::vector<float> back = copy;
  for (auto change = changes.rbegin(); change != changes.rend(); ++change) {
    EXPECT_LT(change->after, change->before);
    back[change->nail] = change->before;
  }
  EXPECT_EQ(back, before);
  for (const double y : {0.3 * edge, 0.3 * edge + 1e-3, 0.5 * edge})
    nails.cut({0, y, edge / 2 + radius}, {edge, y, edge / 2 + radius}, radius);
  EXPECT_EQ(nails.excesses(), copy);
  EXPECT_GT(changes.size(), 50U);
}

}  // namespace
}  // namespace sculpt
