#include "core/mill/rough/ramp.hpp"

#include <gtest/gtest.h>

#include <map>

namespace sculpt {
namespace {

/// The most that a place is lower than the one before it over the same spot.
double deepest(const std::vector<Vec3>& places, double top) {
  std::map<std::pair<double, double>, double> floors;
  double most = 0;
  for (const Vec3& place : places) {
    double& floor = floors.try_emplace({place.x(), place.y()}, top).first->second;
    most = std::max(most, floor - place.z());
    floor = std::min(floor, place.z());
  }
  return most;
}

TEST(Ramp, GoesDownAlongACurveNoDeeperThanASlotMayBe) {
  const Curve open{{0, 0}, {0.01, 0}, {0.02, 0}, {0.02, 0.01}},
      closed{{0, 0}, {0.02, 0}, {0.02, 0.02}, {0, 0.02}, {0, 0}};
  for (const auto& [curve, is_closed] : {std::pair{open, false}, {closed, true}})
    for (const double slot_m : {0.0015, 0.002, 0.005}) {
      const std::vector<Vec3> places = ramp_along(curve, is_closed, 0.5, 0.49, slot_m);
      ASSERT_FALSE(places.empty());
      EXPECT_EQ(places.front(), Vec3(curve.front().x(), curve.front().y(), 0.5));
      EXPECT_LE(deepest(places, 0.5), slot_m * (1 + 1e-9));
      double flat = 0, length = 0;
      for (std::size_t at = 0; at + 1 < places.size(); ++at) {
        const Vec3 way = places[at + 1] - places[at];
        EXPECT_LE(way.z(), 0);
        EXPECT_LE(-way.z(), 0.15 * way.head<2>().norm() + 1e-12);
        if (places[at].z() == 0.49) flat += way.norm();
      }
      for (std::size_t at = 0; at + 1 < curve.size(); ++at) length += (curve[at + 1] - curve[at]).norm();
      EXPECT_NEAR(flat, length, 1e-9) << "the last time at the bottom";
    }
}

TEST(Ramp, IsNotThereWhereItWouldTakeTooLong) {
  const Curve curve{{0, 0}, {0.001, 0}};
  EXPECT_TRUE(ramp_along(curve, false, 0.5, 0.49, 0.005).empty());
  EXPECT_TRUE(ramp_along(curve, false, 0.5, 0.5, 0.005).empty()) << "nothing to go down";
}

}  // namespace
}  // namespace sculpt
