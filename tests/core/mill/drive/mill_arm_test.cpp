#include "core/mill/drive/mill_arm.hpp"

#include <gtest/gtest.h>

#include "core/trajectory/milling/quanta_point.hpp"
#include "tests/core/mill/drive/held_d6.hpp"

namespace sculpt {
namespace {

constexpr double above_m = 0.03;

class MillArmTest : public HeldD6 {
 protected:
  MillArmTest() {
    held.see(cells_of(VoxelSet(n, true), grid, around));
    arm.take_tool(0, held);
  }

  Vec3 above() const { return grid.origin_m + n * grid.voxel_m * Vec3(0.5, 0.5, 1) + Vec3(0, 0, above_m); }
  bool hold_from_above() {
    const HeldTool::Fields& found = fields({0, 0, 1});
    return !found.empty() && arm.hold(*found.front(), 0, above());
  }

  const RunContext run{0, helpers, watch};
  std::vector<Keyframe> emitted;
  const MillArm::Emit emit = [this](std::vector<Keyframe> keyframes) {
    emitted.insert(emitted.end(), keyframes.begin(), keyframes.end());
  };
  MillArm arm{home, home, emit, run};
};

// A bell's inside, where D12 found no way to anything: 145 m of moves into and out of 44 directions.
TEST_F(MillArmTest, ADirectionAlongWhichNothingIsDoneIsNotGoneTo) {
  for (int time = 0; time < 3; ++time) {
    ASSERT_TRUE(hold_from_above());
    EXPECT_EQ(*arm.tip(), above());
  }
  arm.commit({});
  arm.go_home();
  EXPECT_TRUE(emitted.empty());
  EXPECT_FALSE(arm.tip());
}

TEST_F(MillArmTest, TheWayIntoADirectionComesBeforeItsFirstStroke) {
  ASSERT_TRUE(hold_from_above());
  ASSERT_TRUE(hold_from_above());
  const Vec3 beside = above() + Vec3(0.005, 0, 0);
  FollowedMill followed = arm.try_strokes({{beside, false, 1e-3}});
  ASSERT_EQ(followed.strokes(), 1U);
  const std::size_t strokes = followed.keyframes.size();
  arm.commit(std::move(followed));
  ASSERT_GT(emitted.size(), strokes);
  const Keyframe& entry = emitted[emitted.size() - strokes - 1];
  EXPECT_EQ(point_of(entry.mill->tip), above());
  EXPECT_NEAR((point_of(emitted.back().mill->tip) - beside).norm(), 0, 1e-7);
  const std::size_t before = emitted.size();
  arm.commit(arm.try_strokes({{above(), false, 1e-3}}));
  for (std::size_t at = before; at < emitted.size(); ++at) EXPECT_TRUE(emitted[at].mill->is_placed()) << "entered once";
  arm.go_home();
  EXPECT_EQ(emitted.back().q, home);
}

TEST_F(MillArmTest, AnotherGoesOnAsItWouldHave) {
  const PostureField& field = *held.fields({0, 0, 1}, home, run).front();
  const auto go_there_and_back = [&](MillArm& one) {
    emitted.clear();
    EXPECT_TRUE(one.hold(field, 0, above()));
    one.commit(one.try_strokes({{above() + Vec3(0.005, 0, 0), false, 1e-3}}));
    one.go_home();
    std::vector<Configuration> way;
    for (const Keyframe& keyframe : emitted) way.push_back(keyframe.q);
    return way;
  };
  go_there_and_back(arm);
  MillArm other(home, home, emit, run);
  other.go_on(held, arm.memory());
  EXPECT_EQ(go_there_and_back(other), go_there_and_back(arm));
  EXPECT_EQ(arm.memory().transits, 4U) << "two ways there, two back";
  EXPECT_EQ(other.memory().transits, arm.memory().transits);
  EXPECT_EQ(other.memory().ways, arm.memory().ways);
  EXPECT_EQ(other.memory().searched, arm.memory().searched);
}

}  // namespace
}  // namespace sculpt
