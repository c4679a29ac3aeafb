#include "core/mill/map/site.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/core/mill/map/rubble_site.hpp"

namespace sculpt {
namespace {

constexpr std::array<Direction, 3> directions{{{0, 0, 1}, {18, 0, 18}, {10, -12, 9}}};

TEST(Site, FreeIsACutterFromItsFreeHeightOn) {
  double most_spare = 0, least_spare = 1;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const RubbleSite rubble(random, some_cutter(random, seed % 2 == 0), directions[seed % 3]);
    const double clearance = random.between(1e-5, 1e-3);
    for (int place = 0; place < 50; ++place) {
      Vec3 tip = rubble.some_place(random);
      const double lowest = rubble.site().free_height(tip, clearance);
      if (lowest < -1) continue;
      for (const double higher : {0.0, 5e-4, 4e-3}) {
        tip.z() = lowest + higher;
        EXPECT_GE(rubble.room_m(tip), clearance - 1e-7);
      }
      tip.z() = lowest;
      const double spare = rubble.room_m(tip) - clearance;
      most_spare = std::max(most_spare, spare), least_spare = std::min(least_spare, spare);
      EXPECT_LE(lowest, rubble.site().clear_height(tip, tip, clearance, clearance) + 1e-6);
    }
  }
  // It is a bound, by whole cells and columns, and no worse.
  EXPECT_LT(least_spare, 2e-4);
  EXPECT_LT(most_spare, 3e-3);
}

}  // namespace
}  // namespace sculpt
