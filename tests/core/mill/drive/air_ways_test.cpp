#include "core/mill/drive/air_ways.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "core/mill/drive/hop.hpp"
#include "core/mill/map/fixtures.hpp"
#include "tests/core/material/shapes.hpp"
#include "tests/core/mill/drive/held_d6.hpp"

namespace sculpt {
namespace {

using AirWaysTest = HeldD6;

// From below the arm holds the tip high up in one place and far down in another: straight over leads from few to few.
TEST_F(AirWaysTest, LeadAroundWhatTheArmDoesNotReachAndTouchNothing) {
  const Direction direction{18, 18, -15};
  const ToolFrame frame(direction);
  const Vec3 high = grid.origin_m + Vec3::Constant(n * grid.voxel_m), middle = (grid.origin_m + high) / 2;
  const Mesh part = shapes::box(middle - Vec3::Constant(0.03), middle + Vec3::Constant(0.03));
  const Site site(frame, lattice_over(frame, grid.origin_m, high, room_m, 2e-3), held.assembly(), part,
                  fixture_mesh(cell), {1e-4, 1e-4});
  const ReachFloor reach(*fields(direction).front(), around, site, frame.of(middle).z() + 0.25, helpers);
  const Lattice& all = site.lattice();
  const auto is_clear = [&](const Vec3& a, const Vec3& b) {
    return site.clear_height(a, b, air_clearance_m, air_beside_m) <= std::min(a.z(), b.z()) + 1e-9;
  };
  // From where it comes down farthest.
  std::optional<Vec3> from;
  int most = 0;
  for (int b = 0; b < all.height; b += 4)
    for (int a = 0; a < all.width; a += 4) {
      std::optional<Vec3> first;
      int steps = 0;
      for (double z = frame.of(middle).z() + 0.25; z > frame.of(middle).z() - 0.2; z -= 5e-3) {
        const Vec3 at(all.u(a), all.v(b), z);
        const bool is_free = reach.allows(at) && is_clear(at, at);
        if (is_free && !first) first = at;
        if (first && !is_free) break;
        steps += is_free;
      }
      if (steps > most) most = steps, from = first;
    }
  ASSERT_TRUE(from);
  const double lowest = frame.of(middle).z() - 0.2;
  const AirWays ways(site, reach, *from, lowest, {});
  std::vector<Vec3> bent;
  int found = 0, around_something = 0;
  for (int b = 0; b < all.height; b += 5)
    for (int a = 0; a < all.width; a += 5) {
      const Vec3 to(all.u(a), all.v(b), lowest);
      const std::vector<Vec3> way = ways.to(to);
      if (way.empty()) continue;
      EXPECT_EQ(way.front().head<2>(), from->head<2>());
      EXPECT_EQ(way.back().head<2>(), to.head<2>());
      for (std::size_t leg = 0; leg + 1 < way.size(); ++leg) {
        const Vec3 along = way[leg + 1] - way[leg];
        EXPECT_TRUE(along.head<2>().norm() < 1e-9 || std::abs(along.z()) < 1e-9);
        EXPECT_TRUE(reach.allows(way[leg + 1]));
        EXPECT_TRUE(is_clear(way[leg], way[leg + 1]));
      }
      ++found;
      around_something += way.size() > 4;
      if (way.size() > bent.size()) bent = way;
    }
  EXPECT_GT(found, 50);
  EXPECT_GT(around_something, 10);
  // No way goes where the arm refused to.
  ASSERT_GT(bent.size(), 4U);
  const Vec3 refused = bent[2];
  const AirWays fewer(site, reach, *from, lowest, {refused});
  const std::vector<Vec3> other = fewer.to(bent.back());
  EXPECT_NE(other, bent);
  for (std::size_t leg = 0; leg + 1 < other.size(); ++leg) {
    const Vec3 along = other[leg + 1] - other[leg];
    const double share = std::clamp((refused - other[leg]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    EXPECT_GT((refused - other[leg] - share * along).norm(), 1e-3);
  }
}

}  // namespace
}  // namespace sculpt
