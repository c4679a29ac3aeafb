#include "core/sweep/follow.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/sweep/stroke.hpp"
#include "core/trajectory/quantum.hpp"
#include "tests/core/sweep/clamped_cell.hpp"
#include "tests/core/sweep/panda_field.hpp"

namespace sculpt {
namespace {

constexpr int n = 16;
const Vec3 hub(8, 8, 17);

/// Lines to random places and cuts along the axes, all within usable cells: what Columns makes is of this kind. The
/// view's cells are the grid's voxels.
std::vector<Stroke> random_strokes(const PostureField& field, Random& random) {
  const auto whole = [&](int below) { return static_cast<int>(random.next() % static_cast<unsigned>(below)); };
  std::vector<Stroke> strokes;
  while (strokes.size() < 12) {
    const Voxel from{whole(n), whole(n), whole(n)};
    const double tolerance = random.unit() < 0.5 ? 0.04 : 0.5;
    if (!field.usable(centre(from))) continue;
    strokes.push_back({centre(from), 0, tolerance, {}, {}});
    const int axis = whole(3), way = random.unit() < 0.5 ? 1 : -1;
    const Voxel step{axis == 0 ? way : 0, axis == 1 ? way : 0, axis == 2 ? way : 0};
    const int count = 1 + whole(n);
    const Voxel last = from + step * count;
    if (!Grid{n, 1, Vec3::Zero()}.contains(last) || !field.usable(centre(last))) continue;
    strokes.push_back({centre(last), count, 0.04, from + step, last});
  }
  return strokes;
}

/// Samples the joint-linear edge: `ball_at(t)` is where the ball should be, in cells.
template <typename BallAt>
void expect_near(const Configuration& from, const Configuration& to, double ball, double shank, const BallAt& ball_at) {
  const PandaField& panda = PandaField::get();
  const Chain& chain = panda.field.chain();
  const double h = panda.grid.voxel_m, stickout = chain.stickout_m();
  constexpr int samples = 40;
  for (int s = 0; s <= samples; ++s) {
    const double t = static_cast<double>(s) / samples;
    const ToolPose pose = chain.tool_pose(from + t * (to - from));
    const Vec3 off = pose.ball_m - panda.field.ball_m(ball_at(t, pose));
    const Vec3 top_off = off + stickout * (pose.axis - panda.field.view().axis());
    ASSERT_LE(off.norm() / h, ball);
    ASSERT_LE(top_off.norm() / h, shank);
  }
}

/// Plays keyframes against the strokes that they were made of.
class Player {
 public:
  explicit Player(const PathTolerance& tolerance)
      : tolerance_(tolerance), here_(hub), q_(*PandaField::get().field.at(hub)) {}

  /// One stroke, from keyframe `at` (updated) on.
  void play(const Stroke& stroke, const std::vector<Keyframe>& keyframes, std::size_t& at) {
    const Vec3 from = here_;
    int cut = 0;
    for (bool done = false; !done; ++at) {
      ASSERT_LT(at, keyframes.size()) << "the keyframes end within a stroke";
      const Keyframe& keyframe = keyframes[at];
      ASSERT_EQ(keyframe.cut, stroke.count > 0);
      if (keyframe.cut) {
        ASSERT_NO_FATAL_FAILURE(play_cut(stroke, keyframe, from, cut));
      } else {
        ASSERT_NO_FATAL_FAILURE(play_move(stroke, keyframe, from));
      }
      q_ = keyframe.q;
      done = keyframe.cut ? cut == stroke.count : ball_is_at(stroke.to);
    }
    ASSERT_TRUE(ball_is_at(stroke.to));
    here_ = stroke.to;
  }

 private:
  void play_cut(const Stroke& stroke, const Keyframe& keyframe, const Vec3& from, int& cut) const {
    const Vec3 along = (stroke.to - from) / stroke.count;
    const Voxel step{static_cast<int>(along.x()), static_cast<int>(along.y()), static_cast<int>(along.z())};
    const int length = run_length(keyframe), before = cut;
    ASSERT_EQ(keyframe.first, stroke.first + step * before) << "each voxel once and in order";
    ASSERT_EQ(keyframe.last, keyframe.first + step * (length - 1));
    cut += length;
    ASSERT_LE(cut, stroke.count);
    // Beside material the allowance is the tool's own, and the ball is where it should be at each moment.
    expect_near(q_, keyframe.q, tolerance_.ball, tolerance_.shank,
                [&](double t, const ToolPose&) { return Vec3(from + along * (before + t * length)); });
  }

  void play_move(const Stroke& stroke, const Keyframe& keyframe, const Vec3& from) const {
    const PandaField& panda = PandaField::get();
    const Vec3 line = (stroke.to - from).normalized();
    const double length = (stroke.to - from).norm();
    expect_near(q_, keyframe.q, std::max(stroke.tolerance, tolerance_.ball),
                std::max(stroke.tolerance, tolerance_.shank), [&](double, const ToolPose& pose) {
                  const Vec3 cell = (pose.ball_m - panda.grid.origin_m) / panda.grid.voxel_m - Vec3::Constant(0.5);
                  return Vec3(from + line * std::clamp(line.dot(cell - from), 0.0, length));
                });
  }

  bool ball_is_at(const Vec3& cell) const {
    const PostureField& field = PandaField::get().field;
    return (field.chain().tool_pose(q_).ball_m - field.ball_m(cell)).norm() < 1e-6;
  }

  PathTolerance tolerance_;
  Vec3 here_;
  Configuration q_;
};

TEST(Follow, KeepsBallAndShankNearTheLineAndNamesEachVoxelOnceAndInOrder) {
  const PandaField& panda = PandaField::get();
  const PathTolerance tolerance = path_tolerance(panda.scene.tool(), panda.grid.voxel_m);
  std::size_t followed_strokes = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::vector<Stroke> strokes = random_strokes(panda.field, random);
    const FollowedStrokes followed = follow(panda.field, panda.scene.tool(), panda.grid, hub, strokes);
    ASSERT_LE(followed.strokes, strokes.size());
    followed_strokes += followed.strokes;
    all += strokes.size();
    Player player(tolerance);
    std::size_t at = 0;
    for (std::size_t stroke = 0; stroke < followed.strokes; ++stroke) {
      SCOPED_TRACE("stroke " + std::to_string(stroke));
      if (stroke > 0 && strokes[stroke].to == strokes[stroke - 1].to) continue;
      ASSERT_NO_FATAL_FAILURE(player.play(strokes[stroke], followed.keyframes, at));
    }
    ASSERT_EQ(at, followed.keyframes.size()) << "nothing of a stroke that failed is left";
  }
  EXPECT_GT(followed_strokes, all * 3 / 4);
}

TEST(Follow, GivesTheSameKeyframesWhateverComesLater) {
  const PandaField& panda = PandaField::get();
  const auto follow_first = [&](const std::vector<Stroke>& strokes, std::size_t count) {
    return follow(panda.field, panda.scene.tool(), panda.grid, hub,
                  {strokes.begin(), strokes.begin() + static_cast<std::ptrdiff_t>(count)});
  };
  for (std::uint64_t seed = 100; seed < 110; ++seed) {
    Random random(seed);
    const std::vector<Stroke> strokes = random_strokes(panda.field, random);
    const FollowedStrokes all = follow_first(strokes, strokes.size());
    std::size_t keyframes = 0;
    for (std::size_t count = 0; count <= all.strokes; ++count) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", strokes " + std::to_string(count));
      const FollowedStrokes first = follow_first(strokes, count);
      ASSERT_EQ(first.strokes, count);
      ASSERT_LE(first.keyframes.size(), all.keyframes.size());
      for (std::size_t at = 0; at < first.keyframes.size(); ++at) {
        const Keyframe &a = first.keyframes[at], &b = all.keyframes[at];
        ASSERT_TRUE(a.q == b.q && a.cut == b.cut);
        ASSERT_TRUE(!a.cut || (a.first == b.first && a.last == b.last));
      }
      keyframes = first.keyframes.size();
    }
    ASSERT_EQ(keyframes, all.keyframes.size()) << "seed " << seed;
  }
}

TEST(Follow, TakesOneKeyframeForEachOfManyShortStrokes) {
  const PandaField& panda = PandaField::get();
  std::vector<Stroke> strokes{{{4, 4, 12}, 0, 0.5, {}, {}}};
  for (int row = 4; row < 12; ++row) {
    for (int m = 0; m < 6; ++m) {
      const Voxel voxel{row % 2 ? 9 - m : 5 + m, row, 12};
      strokes.push_back({centre(voxel), 1, 0.04, voxel, voxel});
    }
    strokes.push_back({centre({row % 2 ? 4 : 10, row + 1, 12}), 0, 0.04, {}, {}});
  }
  const FollowedStrokes followed = follow(panda.field, panda.scene.tool(), panda.grid, {4, 4, 13}, strokes);
  EXPECT_EQ(followed.strokes, strokes.size());
  EXPECT_EQ(followed.keyframes.size(), strokes.size());
}

TEST(Follow, KeyframesAreWhatIsStored) {
  const PandaField& panda = PandaField::get();
  Random random(7);
  const FollowedStrokes followed =
      follow(panda.field, panda.scene.tool(), panda.grid, hub, random_strokes(panda.field, random));
  ASSERT_FALSE(followed.keyframes.empty());
  for (const Keyframe& keyframe : followed.keyframes) ASSERT_EQ(keyframe.q, rounded(keyframe.q));
}

TEST(Follow, LeavesOutAStrokeThatEndsWhereTheFieldIsNotUsable) {
  const PandaField& panda = PandaField::get();
  Vec3 nowhere(-40, 8, 8);  // far outside the grid, where clamping to a cell of the lattice gives no posture
  const std::vector<Stroke> strokes{{{8, 8, 15}, 0, 0.04, {}, {}}, {nowhere, 0, 0.04, {}, {}}};
  const FollowedStrokes followed = follow(panda.field, panda.scene.tool(), panda.grid, hub, strokes);
  EXPECT_EQ(followed.strokes, 1u);
  EXPECT_LT((panda.field.chain().tool_pose(followed.keyframes.back().q).ball_m - panda.field.ball_m({8, 8, 15})).norm(),
            1e-6);
}

TEST(Follow, NeverGoesThroughWhatStandsBetweenTwoUsablePlaces) {
  constexpr int m = 64;
  const Cell cell = parse_cell(cell_with_pin());
  const Scene full(cell, cell.grid(m), VoxelSet(m, true)), empty(cell, cell.grid(m), VoxelSet(m));
  const PostureField field = make_field(full, cell.home(full.chain()), tool_views(m)[0]);
  Random random(11);
  int followed_strokes = 0, refused = 0;
  for (int trial = 0; trial < 400; ++trial) {
    // The pin is at (32, 48) in cells.
    const double away = random.between(3, 12), height = random.between(60, 65);
    const Vec3 from(random.between(20, 44), 47.5 + away, height), to(from.x(), 47.5 - random.between(3, 12), height);
    SCOPED_TRACE(::testing::Message() << "trial " << trial << ", " << from.transpose() << " to " << to.transpose());
    const auto start = field.at(from);
    if (!start) continue;
    const FollowedStrokes followed = follow(field, full.tool(), full.grid(), from, {{to, 0, 0.04, {}, {}}});
    (followed.strokes == 1 ? followed_strokes : refused) += 1;
    Configuration q = *start;
    for (const Keyframe& keyframe : followed.keyframes) {
      for (int s = 0; s <= 100; ++s) ASSERT_EQ(empty.contact_at(q + (s / 100.0) * (keyframe.q - q)), Contact::none);
      q = keyframe.q;
    }
  }
  EXPECT_GT(followed_strokes, 50);
  EXPECT_GT(refused, 20);
}

TEST(Follow, StrayIsWhatIsLeftOfAVoxelBesideTheTool) {
  Tool tool{};
  tool.ball_radius_m = 0.45e-3;
  tool.shank_radius_m = 0.40e-3;
  EXPECT_NEAR(path_tolerance(tool, 1e-3).ball, 0.04, 1e-12) << "no more than the trajectory's tolerance";
  EXPECT_NEAR(path_tolerance(tool, 1e-3).shank, 0.095, 1e-12);
  tool.ball_radius_m = 0.48e-3;
  EXPECT_NEAR(path_tolerance(tool, 1e-3).ball, 0.015, 1e-12);
}

}  // namespace
}  // namespace sculpt
