#include "core/timing/blend_interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

struct Case {
  Configuration way, bend;
  double delta, most;

  /// Is every joint within its limit at both ends, and r'' too?
  bool allows(double start, double end) const {
    const double s = (end - start) / (2 * delta);
    for (Eigen::Index joint = 0; joint < way.size(); ++joint) {
      const double first = way[joint] * s + bend[joint] * start,
                   last = (way[joint] + bend[joint] * delta) * s + bend[joint] * end;
      if (std::abs(first) > 1 + 1e-9 || std::abs(last) > 1 + 1e-9) return false;
    }
    return std::abs(s) <= most * (1 + 1e-9);
  }
};

Case random_case(Random& random) {
  const auto joints = static_cast<Eigen::Index>(1 + random.next() % 8);
  const auto direction = [&] {
    Configuration way(joints);
    for (double& value : way) value = random.next() % 4 == 0 ? 0 : random.between(-1, 1);
    if (way.norm() == 0) way[0] = 1;
    return Configuration(way.normalized());
  };
  const Configuration before = direction(), after = random.next() % 6 == 0 ? Configuration(-before) : direction();
  const double half = std::pow(10, random.between(-5, 0));
  return {before, (after - before) / (2 * half), half, std::pow(10, random.between(-0.3, 1))};
}

TEST(BlendInterval, LargestStartAndEndAreAllowedAndNothingLargerIs) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Case one = random_case(random);
    const BlendInterval part(one.way, one.bend, one.delta, one.most);
    const double scale = one.delta * std::pow(10, random.between(-2, 1)), end = scale * random.between(0, 1),
                 cap = scale;
    const double start = part.max_start(cap, end);
    ASSERT_GE(start, 0);
    ASSERT_LE(start, cap);
    const double reached = part.max_end(start, end);
    ASSERT_LE(reached, end);
    ASSERT_TRUE(one.allows(start, reached)) << start << " " << reached;
    if (reached < end) {
      ASSERT_FALSE(one.allows(start, std::min(end, reached * 1.001 + 1e-6 * scale)));
    }
    // By brute force nothing that begins faster comes to any end that is allowed.
    for (int at = 0; start < cap && at <= 200; ++at)
      ASSERT_FALSE(one.allows(std::min(cap, start * 1.001 + 1e-6 * scale), end * at / 200)) << start;
  }
}

}  // namespace
}  // namespace sculpt
