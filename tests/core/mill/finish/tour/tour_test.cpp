#include "core/mill/finish/tour/tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

Contour make_ring(const Vec3& middle, double radius) {
  Contour ring;
  for (int at = 0; at <= 60; ++at) {
    const double angle = 2 * std::numbers::pi * (at % 60) / 60;
    ring.push_back(middle + radius * Vec3(std::cos(angle), std::sin(angle), 0));
  }
  return ring;
}

double ways(const std::vector<Contour>& tour) {
  double sum = 0;
  for (std::size_t at = 0; at + 1 < tour.size(); ++at) sum += (tour[at + 1].front() - tour[at].back()).norm();
  return sum;
}

using Edge = std::tuple<double, double, double, double, double, double>;

/// How often each is gone along, either way.
std::map<Edge, int> edges_of(const std::vector<Contour>& contours) {
  std::map<Edge, int> edges;
  for (const Contour& contour : contours)
    for (std::size_t at = 0; at + 1 < contour.size(); ++at) {
      Vec3 a = contour[at], b = contour[at + 1];
      if (std::tuple(a.x(), a.y(), a.z()) > std::tuple(b.x(), b.y(), b.z())) std::swap(a, b);
      ++edges[{a.x(), a.y(), a.z(), b.x(), b.y(), b.z()}];
    }
  return edges;
}

TEST(Tour, GoesAlongEveryEdgeOnce) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Contour> contours;
    for (int number = 0; number < 60; ++number) {
      const Vec3 middle(random.between(0, 10), random.between(0, 10), random.between(0, 1));
      if (number % 3 == 0) {
        contours.push_back(make_ring(middle, random.between(0.1, 1)));
        continue;
      }
      Contour line{middle};
      const auto length = static_cast<int>(random.between(1, 9));
      for (int at = 0; at < length; ++at)
        line.push_back(line.back() + Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-0.1, 0.1)));
      contours.push_back(line);
    }
    const std::vector<Contour> tour = tour_of(contours, 0.7);
    EXPECT_EQ(edges_of(tour), edges_of(contours));
    EXPECT_EQ(tour_of(contours, 0.7), tour);
  }
}

TEST(Tour, GoesFromRingToRingOneAfterTheOther) {
  std::vector<Contour> rings;
  rings.reserve(20);
  for (int number = 0; number < 20; ++number) rings.push_back(make_ring({0, 0, 0}, 1 + 0.1 * number));
  std::ranges::reverse(rings.begin() + 3, rings.begin() + 9);
  const std::vector<Contour> tour = tour_of(rings, 0.6);
  // Nineteen ways from one to the next, and what it takes to come back where it has gone around in parts.
  EXPECT_LT(ways(tour), 2.2 * 19 * 0.1);
}

TEST(Tour, IsNotMuchLongerThanWhatJoinsPlacesOfALattice) {
  Random random(1);
  std::vector<Contour> contours;
  for (int i = 0; i < 15; ++i)
    for (int j = 0; j < 15; ++j) contours.push_back({Vec3(i, j, 0), Vec3(i + 0.01, j, 0)});
  for (std::size_t at = contours.size(); at-- > 1;)
    std::swap(contours[at], contours[static_cast<std::size_t>(random.between(0, static_cast<double>(at + 1)))]);
  const std::vector<Contour> tour = tour_of(contours, 0.1);
  ASSERT_EQ(tour.size(), 225U);
  EXPECT_LT(ways(tour), 1.1 * 224);
}

TEST(Tour, OfNothingOrOneIsThat) {
  EXPECT_TRUE(tour_of({}, 1).empty());
  const std::vector<Contour> one{{Vec3(0, 0, 0), Vec3(1, 0, 0)}};
  EXPECT_EQ(tour_of(one, 1), one);
}

}  // namespace
}  // namespace sculpt
