#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.hpp"
#include "core/collision/scene.hpp"
#include "tests/core/cell/sample_robots.hpp"
#include "tests/core/collision/small_arm.hpp"

namespace sculpt {
namespace {

Scene scene_of(const Cell& cell) {
  const Grid grid = cell.grid(8);
  return Scene(cell, grid, VoxelSet(grid.n, true));
}

bool any_too_near(const std::vector<NearBodies>& all) {
  return std::any_of(all.begin(), all.end(), [](const NearBodies& near) { return near.too_near; });
}

TEST(SceneNear, SomethingIsTooNearExactlyWhereThereIsAContact) {
  const Cell cell = make_test_cell();
  const Scene scene = scene_of(cell);
  Random random(3);
  int contacts = 0;
  for (int sample = 0; sample < 500; ++sample) {
    const Configuration q = random_configuration(scene.chain(), random);
    const Contact contact = scene.contact_at(q);
    const auto near = scene.near_bodies(q, 0);
    EXPECT_EQ(any_too_near(near), contact != Contact::none) << q.transpose();
    EXPECT_TRUE(contact == Contact::tool_material || scene.blocking_links(q).has_value() == (contact != Contact::none))
        << q.transpose();
    contacts += contact != Contact::none;
  }
  EXPECT_GT(contacts, 50);
  EXPECT_LT(contacts, 450);
}

TEST(SceneNear, AGapIsMeasuredToATenthOfAMillimetre) {
  const Cell cell = make_test_cell();
  const Scene scene = scene_of(cell);
  Configuration q = cell.home(scene.chain());
  const std::vector<NearBodies> near = scene.near_bodies(q, 0.3);
  const int base = cell.robot.find_link("base"), disc = cell.robot.find_link("disc");
  const auto at = std::find_if(near.begin(), near.end(), [&](const NearBodies& pair) {
    return std::minmax(pair.first, pair.second) == std::minmax(base, disc);
  });
  ASSERT_NE(at, near.end());
  EXPECT_NEAR(at->gap_m, 0.1, 2e-4) << "the disc's lower side is 0.1 m above the floor";
  EXPECT_FALSE(at->too_near);
}

}  // namespace
}  // namespace sculpt
