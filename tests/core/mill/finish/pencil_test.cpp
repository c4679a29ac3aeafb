#include "core/mill/finish/pencil.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

constexpr double link = 1, alone = 0.1;

TEST(Pencil, GoesThroughACreaseFromEndToEndInWhateverOrderItsPlacesAre) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Vec3> places;
    for (int at = 0; at < 40; ++at) places.emplace_back(0.6 * at, std::sin(0.1 * at), 0.2 * at);
    for (std::size_t at = places.size(); at-- > 1;)
      std::swap(places[at], places[static_cast<std::size_t>(random.between(0, static_cast<double>(at + 1)))]);
    const std::vector<Row> rows = pencil_rows(places, link, alone);
    ASSERT_EQ(rows.size(), places.size() - 1);
    double length = 0;
    for (const Row& row : rows) length += (row.to - row.from).norm();
    EXPECT_LT(length, 39 * 0.62);
    for (const Vec3& place : places)
      EXPECT_TRUE(std::ranges::any_of(
          rows, [&](const Row& row) { return row.from == place.head<2>() || row.to == place.head<2>(); }));
  }
}

TEST(Pencil, EachIsJoinedToTheNearestThatIsLeft) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Vec3> places;
    for (int at = 0; at < 200; ++at)
      places.emplace_back(random.between(0, 6), random.between(0, 6), random.between(0, 2));
    std::vector<Vec3> left(places);
    const auto take = [&](const Vec3& place) { std::erase(left, place); };
    int joined = 0;
    for (const Row& row : pencil_rows(places, link, alone)) {
      const auto at = [&](const Point2& plan) {
        return std::ranges::find_if(places, [&](const Vec3& place) { return place.head<2>() == plan; });
      };
      const Vec3 from = *at(row.from);
      take(from);
      if (at(row.to) == places.end()) continue;  // alone
      const Vec3 to = *at(row.to);
      for (const Vec3& other : left) EXPECT_GE((other - from).norm(), (to - from).norm());
      take(to);
      ++joined;
    }
    EXPECT_GT(joined, 100);
    EXPECT_TRUE(left.empty());
  }
}

TEST(Pencil, PlacesThatAreFarApartAreNotJoined) {
  // In plan the same, far apart along the axis.
  const std::vector<Vec3> places{{0, 0, 0}, {0.1, 0, 5}, {3, 0, 0}};
  const std::vector<Row> rows = pencil_rows(places, link, alone);
  ASSERT_EQ(rows.size(), 3u);
  for (std::size_t at = 0; at < rows.size(); ++at) {
    EXPECT_EQ(rows[at].from, places[at].head<2>());
    EXPECT_NEAR((rows[at].to - rows[at].from).norm(), alone, 1e-12);
  }
  EXPECT_TRUE(pencil_rows({}, link, alone).empty());
}

}  // namespace
}  // namespace sculpt
