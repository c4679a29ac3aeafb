// What is said to be closed must be free on all of each motion of its block.
#include "core/verify/open_items.hpp"

#include <gtest/gtest.h>

#include "tests/core/verify/small_cells.hpp"

namespace sculpt {
namespace {

/// A tool on three slides: the link's place in mm is the configuration in m, times 1000.
struct Slides {
  Slides() {
    add_link(cell.robot, "stock", -1);
    int parent = 0;
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
      parent = add_link(cell.robot, "link" + std::to_string(parent + 1), parent,
                        slide("slide" + std::to_string(parent), axis, -1, 1));
      cell.rest.push_back(0);
    }
  }
  Cell cell;
};

TEST(OpenItems, LeaveOutNoBallThatAMotionPasses) {
  const Slides slides;
  const LinkMotion motion(slides.cell.robot, {0, 1, 2}, slides.cell.rest, 0);
  std::size_t open = 0, all = 0, passed = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto place = [&] { return Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)); };
    TrajectoryPiece piece;
    piece.from = place();
    Configuration at = piece.from;
    const std::size_t keyframes = 1 + random.next() % 300;
    for (std::size_t keyframe = 0; keyframe < keyframes; ++keyframe) {
      at += 0.05 * place();
      piece.keyframes.push_back({at, false, {}, {}});
    }
    std::vector<Vec3> balls;
    for (int ball = 0; ball < 20; ++ball) balls.push_back(1000 * place());
    constexpr double radius_mm = 250;
    const OpenItems items(motion, piece, balls.size(), [&](std::size_t ball, const OpenItems::Box& box) {
      EXPECT_LT((box.poses[3].translation() - 1000 * box.middle).norm(), 1e-6);
      return (1000 * box.middle - balls[ball]).norm() <= radius_mm + 1000 * box.half.norm();
    });
    for (std::size_t keyframe = 0; keyframe < keyframes; ++keyframe) {
      const Configuration& from = keyframe == 0 ? piece.from : piece.keyframes[keyframe - 1].q;
      const Configuration step = piece.keyframes[keyframe].q - from;
      const std::vector<std::size_t>& near = items.of(keyframe);
      open += near.size();
      all += balls.size();
      for (std::size_t ball = 0; ball < balls.size(); ++ball)
        for (int sample = 0; sample <= 10; ++sample) {
          const Vec3 here = 1000 * (from + sample / 10.0 * step);
          if ((here - balls[ball]).norm() > radius_mm) continue;
          ++passed;
          ASSERT_TRUE(std::ranges::count(near, ball) == 1) << "keyframe " << keyframe << ", ball " << ball;
        }
    }
  }
  EXPECT_GT(passed, 500u);
  EXPECT_LT(5 * open, all) << "most should be closed";
}

TEST(OpenItems, AreAllOpenWhereNothingIsProved) {
  TrajectoryPiece piece;
  piece.keyframes.resize(20, {Vec3::Zero(), false, {}, {}});
  const OpenItems items(piece, 3);
  for (std::size_t keyframe = 0; keyframe < 20; ++keyframe)
    EXPECT_EQ(items.of(keyframe), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(OpenItems, OfAnEmptyPieceAreNotAsked) {
  const Slides slides;
  const LinkMotion motion(slides.cell.robot, {0, 1, 2}, slides.cell.rest, 0);
  TrajectoryPiece piece;
  piece.from = Vec3::Zero();
  OpenItems(motion, piece, 3, [](std::size_t, const OpenItems::Box&) {
    ADD_FAILURE() << "asked";
    return true;
  });
}

}  // namespace
}  // namespace sculpt
