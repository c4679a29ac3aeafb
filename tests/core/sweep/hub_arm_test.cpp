#include "core/sweep/hub_arm.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/sweep/directions.hpp"
#include "core/trajectory/quantum.hpp"
#include "tests/core/sweep/panda_field.hpp"

namespace sculpt {
namespace {

class HubArmTest : public testing::Test {
 protected:
  void SetUp() override { directions.find_straight_fields(); }

  const PandaField& panda = PandaField::get();
  const Configuration home = panda.cell.home(panda.scene.chain());
  const Watch watch;
  const Helpers helpers{2};
  Directions directions{panda.scene, home, {0, helpers, watch}};
};

TEST_F(HubArmTest, GoesFromHubToHubAndHomeByCertifiedEdges) {
  ASSERT_TRUE(directions.stock_turn());
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Random random(seed);
    Configuration at = home;
    const HubArm::Emit follow = [&](const std::vector<Keyframe>& keyframes) {
      for (const Keyframe& keyframe : keyframes) {
        EXPECT_FALSE(keyframe.cut);
        EXPECT_EQ(panda.scene.certify(at, keyframe.q), Contact::none);
        EXPECT_EQ(rounded(keyframe.q), keyframe.q);
        at = keyframe.q;
      }
    };
    HubArm arm(panda.scene, home, directions.stock_turn(), seed, follow, watch);
    for (int entry = 0; entry < 8; ++entry) {
      const PostureField& field = directions.field(random.next() % 5);
      SCOPED_TRACE("seed " + std::to_string(seed) + ", entry " + std::to_string(entry) + " of direction " +
                   std::to_string(directions.number_of(field)));
      if (arm.field() == &field) continue;
      ASSERT_TRUE(arm.enter(field));
      const Vec3 hub = ToolView::place(field.hub());
      EXPECT_EQ(arm.field(), &field);
      EXPECT_EQ(arm.at(), hub);
      EXPECT_EQ(at, field.at(hub));
    }
    arm.go_home();
    EXPECT_EQ(at, home);
  }
}

TEST_F(HubArmTest, DrawsBackAndHasTheStockTurnedFromSideToSide) {
  std::vector<Keyframe> way;
  const HubArm::Emit take = [&](std::vector<Keyframe> keyframes) { way = std::move(keyframes); };
  HubArm arm(panda.scene, home, directions.stock_turn(), 0, take, watch);
  ASSERT_TRUE(arm.enter(directions.field(1)));
  const Configuration before = way.back().q;
  ASSERT_TRUE(arm.enter(directions.field(2)));
  ASSERT_EQ(way.size(), 3u);
  const Configuration turned = way[1].q - way[0].q, moved = way[2].q - before;
  const Eigen::Index turn = *directions.stock_turn();
  EXPECT_NEAR(std::abs(turned[turn]), turned.norm(), 1e-12) << "only the stock turns";
  EXPECT_NEAR(moved[turn], turned[turn], 1e-6);
}

}  // namespace
}  // namespace sculpt
