#include "core/sweep/columns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"

namespace sculpt {
namespace {

struct Shape {
  VoxelSet stock, keep;
};

Shape random_shape(int n, std::uint64_t seed) {
  Random random(seed);
  Shape shape{VoxelSet(n, true), VoxelSet(n)};
  const double keep = random.unit() * 0.5, air = random.unit() < 0.5 ? random.unit() * 0.4 : 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        if (random.unit() < air)
          shape.stock.erase({i, j, k});
        else if (random.unit() < keep)
          shape.keep.insert({i, j, k});
      }
  return shape;
}

ReachRows everywhere(int n) {
  return {n, [](const Vec3&) { return Voxel{}; }, [](Voxel) { return true; }};
}

/// What the strokes do, cell by cell; shares nothing with Columns but the words.
class Replay {
 public:
  Replay(const ToolView& view, VoxelSet standing, VoxelSet keep)
      : view_(view), standing_(std::move(standing)), keep_(std::move(keep)), at_(0, 0, view.n + 1) {}

  void run(const std::vector<Stroke>& strokes) {
    for (const Stroke& stroke : strokes) {
      if (stroke.count > 0)
        cut(stroke);
      else
        pass(stroke);
      at_ = stroke.to;
    }
  }
  std::uint64_t removed() const { return removed_; }
  const VoxelSet& standing() const { return standing_; }

 private:
  bool stands(int a, int b, int c) const {
    const Grid grid{view_.n, 1, Vec3::Zero()};
    const Voxel voxel = view_.voxel({a, b, c});
    return grid.contains(voxel) && standing_.contains(voxel);
  }

  /// Nothing stands at the cells that the tool, off by `tolerance`, can be in, nor above them.
  void expect_free(const Vec3& at, double tolerance) const {
    const double reach = 0.45 + tolerance;
    const auto low = [&](double x) { return static_cast<int>(std::lround(x - reach)); };
    const auto high = [&](double x) { return static_cast<int>(std::lround(x + reach)); };
    for (int b = low(at.y()); b <= high(at.y()); ++b)
      for (int a = low(at.x()); a <= high(at.x()); ++a)
        for (int c = low(at.z()); c < view_.n; ++c) ASSERT_FALSE(stands(a, b, c)) << a << ' ' << b << ' ' << c;
  }

  void pass(const Stroke& stroke) const {
    const int steps = 1 + static_cast<int>(10 * (stroke.to - at_).norm());
    for (int s = 0; s <= steps; ++s)
      ASSERT_NO_FATAL_FAILURE(
          expect_free(at_ + (stroke.to - at_) * (static_cast<double>(s) / steps), stroke.tolerance));
  }

  void cut(const Stroke& stroke) {
    const Vec3 step = (stroke.to - at_) / stroke.count;
    ASSERT_NEAR(step.cwiseAbs().sum(), 1, 1e-12) << "a cut goes along one axis, a cell at a time";
    for (int m = 1; m <= stroke.count; ++m) {
      const Vec3 here = at_ + m * step;
      const Voxel cell{static_cast<int>(std::lround(here.x())), static_cast<int>(std::lround(here.y())),
                       static_cast<int>(std::lround(here.z()))};
      const Voxel voxel = view_.voxel(cell), way = stroke.last - stroke.first;
      const Voxel named =
          stroke.first + Voxel{way.i / std::max(1, stroke.count - 1), way.j / std::max(1, stroke.count - 1),
                               way.k / std::max(1, stroke.count - 1)} *
                             (m - 1);
      ASSERT_EQ(voxel, named);
      ASSERT_TRUE(standing_.contains(voxel)) << "cut twice";
      ASSERT_FALSE(keep_.contains(voxel));
      standing_.erase(voxel);
      ++removed_;
      ASSERT_NO_FATAL_FAILURE(expect_free(here, 0.04));
    }
  }

  ToolView view_;
  VoxelSet standing_, keep_;
  Vec3 at_;
  std::uint64_t removed_ = 0;
};

TEST(Strokes, CutAllThatLiesFreeAlongEveryDirectionAndTouchNothingElse) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const int n = 8 << seed % 2;
    const Shape shape = random_shape(n, seed);
    for (const ToolView& view : tool_views(n)) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", axis " + std::to_string(view.step[2].i) +
                   std::to_string(view.step[2].j) + std::to_string(view.step[2].k));
      const ReachRows reach = everywhere(n);
      Columns columns(view, shape.stock, shape.keep, reach);
      const std::uint64_t expected = columns.count_cuttable();
      Replay replay(view, shape.stock, shape.keep);
      Vec3 at(0, 0, n + 1);
      for (int c = n - 1; c >= 0; --c) ASSERT_NO_FATAL_FAILURE(replay.run(columns.cut_layer(c, at, 0.04)));
      ASSERT_NO_FATAL_FAILURE(replay.run(columns.rise(at, 0.04)));
      ASSERT_EQ(replay.removed(), expected);
    }
  }
}

TEST(Strokes, CutWhatIsReachableOfRowsLongerThanAWord) {
  const int n = 128;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const ToolView view = tool_views(n)[seed % 5];
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Shape shape{VoxelSet(n), VoxelSet(n)};
    for (int c = 0; c < 6; ++c)
      for (int b = 60; b < 70; ++b)
        for (int a = 50; a < 80; ++a) {
          if (random.unit() < 0.9) shape.stock.insert(view.voxel({a, b, c}));
          if (random.unit() < 0.02) shape.keep.insert(view.voxel({a, b, c}));
        }
    const auto part = [](const Vec3& cell) { return Voxel{int(cell.x()) / 5, int(cell.y()) / 4, int(cell.z()) / 3}; };
    const auto reachable = [&](Voxel in) {
      return mix(seed, static_cast<std::uint64_t>(in.i + 64 * (in.j + 64 * in.k))) % 8 > 0;
    };
    const ReachRows reach(n, part, reachable);
    Columns columns(view, shape.stock, shape.keep, reach);
    const std::uint64_t expected = columns.count_cuttable();
    EXPECT_GT(expected, 500u);
    Replay replay(view, shape.stock, shape.keep);
    Vec3 at(0, 0, n + 1);
    for (int c = n - 1; c >= 0; --c) {
      Vec3 from = at;
      const std::vector<Stroke> strokes = columns.cut_layer(c, at, 0.04);
      ASSERT_NO_FATAL_FAILURE(replay.run(strokes));
      for (const Stroke& stroke : strokes) {
        for (int m = 1; m <= stroke.count; ++m)
          ASSERT_TRUE(reachable(part(from + (stroke.to - from) * (static_cast<double>(m) / stroke.count))));
        from = stroke.to;
      }
    }
    ASSERT_EQ(replay.removed(), expected);
  }
}

TEST(Strokes, WhatIsTakenBackStandsAgainAndWhatIsGivenUpIsLeft) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const int n = 8;
    const Shape shape = random_shape(n, seed);
    const ToolView view = tool_views(n)[seed % 5];
    Random random(seed);
    const ReachRows reach = everywhere(n);
    Columns columns(view, shape.stock, shape.keep, reach);
    Replay replay(view, shape.stock, shape.keep);
    Vec3 at(0, 0, n + 1);
    for (int c = n - 1; c >= 0;) {
      const Vec3 from = at;
      std::vector<Stroke> strokes = columns.cut_layer(c, at, 0.04);
      std::size_t done = strokes.size();
      if (!strokes.empty() && random.unit() < 0.5) done = random.next() % strokes.size();
      std::size_t failed = done;
      while (failed < strokes.size() && strokes[failed].count == 0) ++failed;
      for (std::size_t s = strokes.size(); s-- > done;) columns.restore(strokes[s], s == failed);
      if (done == strokes.size()) --c;
      strokes.resize(done);
      at = done == 0 ? from : strokes.back().to;
      ASSERT_NO_FATAL_FAILURE(replay.run(strokes));
    }
    const Columns fresh(view, replay.standing(), shape.keep, reach);
    ASSERT_EQ(columns.count_cuttable(), fresh.count_cuttable());
  }
}

TEST(Strokes, AFullBlockTakesOneRowAfterTheOther) {
  const int n = 16;
  const ReachRows reach = everywhere(n);
  Columns columns(tool_views(n)[0], VoxelSet(n, true), VoxelSet(n), reach);
  Vec3 at(0, 0, n + 1);
  double travelled = 0;
  for (int c = n - 1; c >= 0; --c) {
    Vec3 here = at;
    for (const Stroke& stroke : columns.cut_layer(c, at, 0.04)) {
      if (stroke.count == 0) travelled += (stroke.to - here).norm();
      here = stroke.to;
    }
  }
  EXPECT_LE(travelled, 3) << "into the first layer from above, and nothing else";
}

}  // namespace
}  // namespace sculpt
