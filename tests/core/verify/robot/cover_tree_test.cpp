// Boxes that a tree finds near another one, against all pairs of them.
#include "core/verify/robot/cover_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

Vec3 vector_in(Random& random, double half) {
  return {random.between(-half, half), random.between(-half, half), random.between(-half, half)};
}

CoverTree tree_of(Random& random, int triangles, double half_mm) {
  std::vector<CoverTree::Triangle> made;
  for (int at = 0; at < triangles; ++at) {
    const Vec3 corner = vector_in(random, half_mm);
    made.push_back({corner, corner + vector_in(random, 5), corner + vector_in(random, 5)});
  }
  return CoverTree(std::move(made));
}

bool meet(const fcl::AABBd& a, const fcl::AABBd& b, const Frame& seen, double grow) {
  return !fcl::obbDisjoint<double>(seen.linear(), seen * b.center() - a.center(),
                                   (a.max_ - a.min_) / 2 + Vec3::Constant(grow), (b.max_ - b.min_) / 2);
}

TEST(CoverTree, FindsWhatIsNearAndNothingElse) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const CoverTree a = tree_of(random, 1 + static_cast<int>(seed) * 7, 100), b = tree_of(random, 900, 40);
    Frame seen = Frame::Identity();
    seen.linear() = Eigen::AngleAxisd(random.between(-3, 3), vector_in(random, 1).normalized()).toRotationMatrix();
    seen.translation() = vector_in(random, 150);
    const double grow = random.between(0, 20);
    std::vector<const fcl::AABBd*> expected, found;
    for (const fcl::AABBd& box : a.boxes())
      if (std::ranges::any_of(b.boxes(), [&](const fcl::AABBd& other) { return meet(box, other, seen, grow); }))
        expected.push_back(&box);
    EXPECT_FALSE(a.any_near(b, seen, grow, [&](const fcl::AABBd& box) { return found.push_back(&box), false; }));
    std::ranges::sort(found);
    EXPECT_EQ(found, expected) << "seed " << seed;
    int asked = 0;
    EXPECT_EQ(a.any_near(b, seen, grow, [&](const fcl::AABBd&) { return ++asked > 0; }), !expected.empty());
    EXPECT_EQ(asked, expected.empty() ? 0 : 1) << "seed " << seed;
  }
}

TEST(CoverTree, EveryTriangleIsInABox) {
  Random random(3);
  std::vector<CoverTree::Triangle> triangles;
  for (int at = 0; at < 1000; ++at)
    triangles.push_back({vector_in(random, 50), vector_in(random, 50), vector_in(random, 50)});
  const CoverTree tree(triangles);
  for (const CoverTree::Triangle& triangle : triangles)
    EXPECT_TRUE(std::ranges::any_of(tree.boxes(), [&](const fcl::AABBd& box) {
      return std::ranges::all_of(triangle, [&](const Vec3& corner) { return box.contain(corner); });
    }));
}

TEST(CoverTree, NothingIsNearNothing) {
  Random random(1);
  const CoverTree some = tree_of(random, 10, 1), none;
  const auto any = [](const fcl::AABBd&) { return true; };
  EXPECT_FALSE(none.any_near(some, Frame::Identity(), 1e3, any));
  EXPECT_FALSE(some.any_near(none, Frame::Identity(), 1e3, any));
}

}  // namespace
}  // namespace sculpt
