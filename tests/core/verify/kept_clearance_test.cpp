// A kept clearance must never outlive what it says.
#include "core/verify/kept_clearance.hpp"

#include <gtest/gtest.h>

#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

Cell chain_of_five(Random& random) {
  Cell cell;
  add_link(cell.robot, "link0", -1);
  for (int link = 1; link < 6; ++link) {
    const auto number = [&] { return random.between(-0.3, 0.3); };
    Joint joint = hinge("joint" + std::to_string(link), Vec3(number(), number(), number()),
                        Vec3(number(), number(), 0.4).normalized());
    if (link == 3) joint.kind = JointKind::prismatic;
    add_link(cell.robot, "link" + std::to_string(link), link == 5 ? 1 : link - 1, joint);
    cell.rest.push_back(0);
  }
  return cell;
}

TEST(KeptClearance, PointsComeNoNearerThanItSaysAnywhereOnTheMotion) {
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Cell cell = chain_of_five(random);
    const LinkMotion motion(cell.robot, {0, 1, 2, 3, 4}, cell.rest, 2);
    const Around first{4, 100 * Vec3(random.between(-1, 1), 1, 0), 30}, second{5, Vec3(50, 0, 20), 40};
    KeptClearance kept(ApproachBound(motion, first, second));
    Configuration anchor(5), from(5), step(5);
    for (Eigen::Index at = 0; at < 5; ++at) {
      anchor[at] = random.between(-2, 2);
      from[at] = anchor[at] + random.between(-0.2, 0.2);
      step[at] = random.between(-0.2, 0.2);
    }
    std::vector<Frame> poses;
    motion.place_links(anchor, poses);
    kept.move_anchor(anchor, poses);
    EXPECT_FALSE(kept.covers({from, from + step}));
    // Some point of each: the distance between two of them.
    const Vec3 a = first.centre + 30 * Vec3(random.between(-1, 1), random.between(-1, 1), 0.1).normalized();
    const Vec3 b = second.centre + 40 * Vec3(random.between(-1, 1), 0.1, random.between(-1, 1)).normalized();
    const auto distance = [&] { return (poses[4] * a - poses[5] * b).norm(); };
    const double at_anchor = distance(), approach = kept.approach({from, from + step});
    for (int sample = 0; sample <= 50; ++sample) {
      motion.place_links(from + step * sample / 50, poses);
      EXPECT_GE(distance(), at_anchor - approach - 1e-9);
    }
    kept.prove(at_anchor);
    EXPECT_EQ(kept.covers({from, from + step}), approach <= at_anchor);
    covered += kept.covers({from, from + step});
    kept.forget();
    EXPECT_FALSE(kept.covers({from, from + step}));
  }
  EXPECT_GT(covered, 10);
  EXPECT_LT(covered, 290);
}

}  // namespace
}  // namespace sculpt
