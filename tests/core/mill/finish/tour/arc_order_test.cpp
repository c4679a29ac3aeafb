#include "core/mill/finish/tour/arc_order.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

constexpr std::size_t arcs = 12;

ArcOrder make_order(Random& random) {
  std::vector<Vec3> ends;
  std::vector<std::uint32_t> order;
  for (std::uint32_t arc = 0; arc < arcs; ++arc) {
    for (int end = 0; end < 2; ++end)
      ends.emplace_back(random.between(0, 1), random.between(0, 1), random.between(0, 1));
    order.push_back(2 * arc);
  }
  return {ends, order};
}

/// Turns or swaps some.
void change(ArcOrder& order, Random& random) {
  const auto some = [&](std::size_t from, std::size_t to) {
    return from + static_cast<std::size_t>(random.between(0, static_cast<double>(to - from + 1)));
  };
  const std::size_t first = some(0, arcs), middle = some(first, arcs), end = some(middle, arcs);
  random.unit() < 0.5 ? order.turn(first, end) : order.swap(first, middle, end);
}

TEST(ArcOrder, KnowsWhereEachArcIs) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    ArcOrder order = make_order(random);
    for (int number = 0; number < 20; ++number) change(order, random);
    for (std::uint32_t arc = 0; arc < arcs; ++arc) EXPECT_EQ(order.arc(order.place(arc)), arc);
    double sum = 0, same = 0;
    for (std::size_t place = 0; place < arcs; ++place) {
      sum += order.way_after(place);
      same += order.way_before(place);
      EXPECT_EQ(order.begin_of(place) ^ order.end_of(place), 1U);
    }
    EXPECT_NEAR(sum, same, 1e-12);
  }
}

TEST(ArcOrder, GoesBackToWhatWasKept) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    ArcOrder order = make_order(random);
    for (int number = 0; number < 5; ++number) change(order, random);
    order.keep();
    const std::vector<std::uint32_t> kept = order.order();
    for (int number = 0; number < 20; ++number) change(order, random);
    order.undo();
    EXPECT_EQ(order.order(), kept);
    for (std::uint32_t arc = 0; arc < arcs; ++arc) EXPECT_EQ(order.arc(order.place(arc)), arc);
    order.undo();
    EXPECT_EQ(order.order(), kept);
  }
}

}  // namespace
}  // namespace sculpt
