#include "core/mill/finish/nails.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/random.hpp"
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

TEST(Nails, WhatACutWouldLeaveIsWhatItLeaves) {
  const PartInGrid slab = make_slab(edge);
  Nails nails(slab.mesh, slab.voxels, slab.grid, 1000, 10);
  constexpr double most = 2e-4;
  for (const double y : {0.3 * edge, 0.3 * edge + 1e-3, 0.5 * edge}) {
    SCOPED_TRACE(y);
    const Vec3 from(0, y, edge / 2 + radius), to(edge, y, edge / 2 + radius);
    std::map<std::uint32_t, double> left;
    const auto is_odd = [](std::uint32_t nail) { return nail % 2 == 1; };
    nails.for_each_cut(from, to, radius, most, is_odd,
                       [&](std::uint32_t nail, double excess) { left.emplace(nail, excess); });
    std::vector<double> before;
    for (std::size_t nail = 0; nail < nails.size(); ++nail) before.push_back(nails.excess(nail));
    nails.cut(from, to, radius);
    std::size_t finished = 0;
    for (std::uint32_t nail = 0; nail < nails.size(); ++nail) {
      const auto known = left.find(nail);
      if (known != left.end()) {
        EXPECT_TRUE(is_odd(nail));
        EXPECT_NEAR(nails.excess(nail), std::min(before[nail], known->second), 1e-9);
      } else if (is_odd(nail) && nails.excess(nail) < before[nail]) {
        EXPECT_GT(nails.excess(nail), most);
      }
      finished += known != left.end() && known->second <= most;
    }
    EXPECT_GT(finished, 10U);
  }
}

/// Gaps between them are small: over a facet they are spread evenly.
TEST(Nails, AreSpreadEvenly) {
  const PartInGrid slab = make_slab(edge);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const Nails nails(slab.mesh, slab.voxels, slab.grid, 4000, seed);
    const double apart = std::sqrt(nails.area_m2());
    Random random(seed);
    int far = 0;
    constexpr int asked = 2000;
    for (int number = 0; number < asked; ++number) {
      const Vec3 at(random.between(0, edge), random.between(0, edge), edge / 2);
      bool is_near = false;
      nails.for_each_near(at, apart, [&](std::uint32_t nail) { is_near |= (nails[nail].point - at).norm() < apart; });
      far += !is_near;
    }
    // Of places spread at random one in 23 is farther from all nails: exp(-pi).
    EXPECT_LT(far, asked / 50);
  }
}

}  // namespace
}  // namespace sculpt
