#include "core/mill/finish/tour/short_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

std::vector<Contour> make_arcs(std::size_t count, double edge, Random& random) {
  std::vector<Contour> arcs;
  for (std::size_t arc = 0; arc < count; ++arc) {
    const Vec3 from(random.between(0, edge), random.between(0, edge), random.between(0, edge / 10));
    arcs.push_back({from, from + Vec3(random.between(-1, 1), random.between(-1, 1), 0)});
  }
  return arcs;
}

double ways(const std::vector<Contour>& arcs, const std::vector<std::uint32_t>& order) {
  const auto end = [&](std::uint32_t number) {
    return number % 2 == 0 ? arcs[number / 2].front() : arcs[number / 2].back();
  };
  double sum = 0;
  for (std::size_t at = 0; at + 1 < order.size(); ++at) sum += (end(order[at] ^ 1U) - end(order[at + 1])).norm();
  return sum;
}

TEST(ShortOrder, HasEveryArcOnce) {
  for (const std::size_t count : {1, 2, 3, 5, 40, 300}) {
    SCOPED_TRACE(count);
    Random random(count);
    const std::vector<Contour> arcs = make_arcs(count, 10, random);
    std::vector<std::uint32_t> order = short_order(arcs);
    EXPECT_EQ(short_order(arcs), order);
    for (std::uint32_t& end : order) end /= 2;
    std::ranges::sort(order);
    ASSERT_EQ(order.size(), count);
    for (std::uint32_t arc = 0; arc < count; ++arc) EXPECT_EQ(order[arc], arc);
  }
}

TEST(ShortOrder, OfFewIsTheShortestNearly) {
  double sum = 0, least_sum = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::vector<Contour> arcs = make_arcs(6, 4, random);
    std::vector<std::uint32_t> numbers{0, 1, 2, 3, 4, 5};
    double least = std::numeric_limits<double>::infinity();
    do {
      for (std::uint32_t turned = 0; turned < 64; ++turned) {
        std::vector<std::uint32_t> order;
        order.reserve(numbers.size());
        for (const std::uint32_t arc : numbers) order.push_back(2 * arc + (turned >> arc & 1U));
        least = std::min(least, ways(arcs, order));
      }
    } while (std::next_permutation(numbers.begin(), numbers.end()));
    const double found = ways(arcs, short_order(arcs));
    EXPECT_GE(found, least - 1e-9);
    EXPECT_LE(found, 1.3 * least);
    sum += found;
    least_sum += least;
  }
  EXPECT_LE(sum, 1.03 * least_sum);
}

}  // namespace
}  // namespace sculpt
