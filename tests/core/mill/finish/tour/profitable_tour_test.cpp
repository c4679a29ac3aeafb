#include "core/mill/finish/tour/profitable_tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

constexpr double far = 3;

Contour make_line(double x, double length) {
  return {Vec3(x, 0, 0), Vec3(x + length, 0, 0)};
}

/// What some contours are worth, less what it takes to go along them.
double profit(const std::vector<Contour>& tour, const std::vector<double>& worth,
              const std::vector<std::size_t>& kept) {
  double sum = kept.empty() ? 0 : -far;
  for (std::size_t at = 0; at < kept.size(); ++at) {
    sum += worth[kept[at]] - length_m(tour[kept[at]]);
    if (at > 0) sum -= std::min(far, (tour[kept[at - 1]].back() - tour[kept[at]].front()).norm());
  }
  return sum;
}

TEST(ProfitableTour, LeavesOutWhatIsNotWorthTheWay) {
  // One by one, a long way off, and one that is worth less than its own length but lies on the way.
  const std::vector<Contour> tour{make_line(0, 1), make_line(1.1, 1), make_line(20, 0.1), make_line(2.2, 1)};
  EXPECT_EQ(profitable(tour, {5, 0.95, 2, 5}, far), (std::vector<std::size_t>{0, 1, 3}));
  EXPECT_EQ(profitable(tour, {5, 0.95, 9, 5}, far), (std::vector<std::size_t>{0, 2, 3}));
  EXPECT_EQ(profitable(tour, {5, 0.1, 0, 0.2}, far), (std::vector<std::size_t>{0}));
}

TEST(ProfitableTour, OfWhatIsWorthLittleIsNothing) {
  EXPECT_TRUE(profitable({}, {}, far).empty());
  EXPECT_TRUE(profitable({make_line(0, 1)}, {3.9}, far).empty());
  EXPECT_EQ(profitable({make_line(0, 1)}, {4.1}, far).size(), 1U);
}

TEST(ProfitableTour, IsTheBestOfAll) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Contour> tour;
    std::vector<double> worth;
    for (int number = 0; number < 10; ++number) {
      const Vec3 from(random.between(0, 4), random.between(0, 4), 0);
      tour.push_back({from, from + Vec3(random.between(-1, 1), random.between(-1, 1), 0)});
      worth.push_back(random.between(0, 3));
    }
    double best = 0;
    for (unsigned chosen = 0; chosen < 1U << tour.size(); ++chosen) {
      std::vector<std::size_t> kept;
      for (std::size_t number = 0; number < tour.size(); ++number)
        if ((chosen >> number & 1U) != 0) kept.push_back(number);
      best = std::max(best, profit(tour, worth, kept));
    }
    EXPECT_NEAR(profit(tour, worth, profitable(tour, worth, far)), best, 1e-9);
  }
}

}  // namespace
}  // namespace sculpt
