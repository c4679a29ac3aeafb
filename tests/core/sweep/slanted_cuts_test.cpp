#include "core/sweep/slanted_cuts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "core/collision/material.hpp"
#include "core/motion/tool/tool_reach.hpp"
#include "tests/core/base/cases.hpp"

namespace sculpt {
namespace {

bool any_voxel(Voxel) {
  return true;
}

bool anywhere(const Vec3&) {
  return true;
}

struct Shape {
  VoxelSet stock, keep;
};

/// Boxes of keep in a block, some of it air.
Shape random_shape(int n, std::uint64_t seed) {
  Random random(seed);
  Shape shape{VoxelSet(n, true), VoxelSet(n)};
  const double air = random.unit() * 0.4, keep = random.unit() * 0.3;
  for_each_voxel(VoxelSet(n, true), [&](Voxel v) {
    if (random.unit() < air)
      shape.stock.erase(v);
    else if (random.unit() < keep)
      shape.keep.insert(v);
  });
  return shape;
}

/// The voxel that a part of a cut removes.
Voxel voxel_of(const Stroke& cut, int part) {
  const Voxel way = cut.last - cut.first;
  const int steps = std::max(1, cut.count - 1);
  return cut.first + Voxel{way.i / steps, way.j / steps, way.k / steps} * part;
}

/// What the strokes do, by capsules against the material; shares nothing with SlantedCuts but the words.
class Replay {
 public:
  Replay(const ToolView& view, const Shape& shape, Voxel gate)
      : view_(view), gate_(gate.i, gate.j, gate.k), material_(shape.stock), keep_(shape.keep), at_(gate_) {}

  void run(const Sortie& sortie) {
    ASSERT_EQ(sortie.strokes.size(), sortie.serves.size());
    std::size_t cuts = 0;
    for (std::size_t s = 0; s < sortie.strokes.size(); ++s) {
      const Stroke& stroke = sortie.strokes[s];
      ASSERT_GT(sortie.strokes[sortie.serves[s]].count, 0);
      ASSERT_TRUE(stroke.count == 0 || sortie.serves[s] == s);
      for (int part = 0; part < std::max(1, stroke.count); ++part) ASSERT_NO_FATAL_FAILURE(play(stroke, part));
      at_ = stroke.to;
      cuts += static_cast<std::size_t>(stroke.count);
    }
    ASSERT_EQ(at_, gate_) << "a sortie ends where it began";
    ASSERT_EQ(cuts, sortie.cuts);
    removed_ += cuts;
  }
  std::uint64_t removed() const { return removed_; }
  const VoxelSet& standing() const { return material_.solid(); }

 private:
  Vec3 in_voxels(const Vec3& cell) const { return view_.ball_m({view_.n, 1, Vec3::Zero()}, cell); }

  void play(const Stroke& stroke, int part) {
    const int parts = std::max(1, stroke.count);
    const Vec3 from = at_ + (stroke.to - at_) * (static_cast<double>(part) / parts),
               to = at_ + (stroke.to - at_) * ((part + 1.0) / parts);
    std::optional<Voxel> exempt;
    if (stroke.count > 0) {
      exempt = voxel_of(stroke, part);
      ASSERT_TRUE(material_.contains(*exempt)) << "cut twice, or air";
      ASSERT_FALSE(keep_.contains(*exempt));
      ASSERT_EQ(in_voxels(to), Vec3(exempt->i + 0.5, exempt->j + 0.5, exempt->k + 0.5));
    }
    const double radius = stroke.tolerance > 0 ? 0.45 + stroke.tolerance : 0.5 - 1e-6;
    const int samples = 1 + static_cast<int>(16 * (to - from).norm());
    for (int s = 0; s <= samples; ++s) {
      const Vec3 cell = from + (to - from) * (static_cast<double>(s) / samples), ball = in_voxels(cell);
      const Vec3 farthest = Vec3::Constant(view_.n - 1) + 2.0 * Vec3(view_.lean.i, view_.lean.j, view_.lean.k);
      ASSERT_TRUE((cell.array() >= 0).all() && (cell.array() <= farthest.array()).all()) << cell.transpose();
      ASSERT_FALSE(material_.meets_capsule({ball, ball + 2.0 * view_.n * view_.axis()}, radius, exempt))
          << cell.transpose();
    }
    if (exempt) material_.remove(*exempt);
  }

  ToolView view_;
  Vec3 gate_;
  Material material_;
  VoxelSet keep_;
  Vec3 at_;
  std::uint64_t removed_ = 0;
};

Voxel gate_of(int n) {
  return {n / 2, n / 2, n + 1};
}

std::vector<Voxel> list(VoxelSet voxels, const VoxelSet& but_not) {
  voxels -= but_not;
  std::vector<Voxel> all;
  for_each_voxel(voxels, [&](Voxel v) { all.push_back(v); });
  return all;
}

std::uint64_t count_within_reach(const ToolView& view, const VoxelSet& standing, const std::vector<Voxel>& wanted) {
  const Voxel way = view.along(view.lean);
  return wanted.size() - find_out_of_tool_reach(standing, wanted, {way}, 2.0 * view.n, {}).size();
}

TEST(SlantedCuts, CutAllThatTheToolCanComeToAndTouchNothingElse) {
  for (std::uint64_t seed = 0; seed < cases(30u); ++seed) {
    const int n = 8 << seed % 2;
    const Shape shape = random_shape(n, seed);
    const std::vector<Voxel> wanted = list(shape.stock, shape.keep);
    for (const ToolView& view : tilted_views(n)) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", axis " << view.axis().transpose());
      SlantedCuts cuts(view, shape.stock, wanted, gate_of(n), anywhere, any_voxel);
      Replay replay(view, shape, gate_of(n));
      const std::size_t most = 1 + seed * 7;
      for (Sortie sortie = cuts.plan_sortie(most); sortie.cuts > 0; sortie = cuts.plan_sortie(most)) {
        ASSERT_LE(sortie.cuts, most);
        ASSERT_NO_FATAL_FAILURE(replay.run(sortie));
      }
      ASSERT_EQ(replay.removed(), count_within_reach(view, shape.stock, wanted));
    }
  }
}

TEST(SlantedCuts, WhatIsTakenBackStandsAgainAndWhatIsGivenUpIsLeft) {
  const int n = 8;
  std::size_t removed = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Shape shape = random_shape(n, seed);
    VoxelSet left_out = shape.keep;
    const ToolView view = tilted_views(n)[seed % 12];
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ", axis " << view.axis().transpose());
    Random random(seed);
    SlantedCuts cuts(view, shape.stock, list(shape.stock, shape.keep), gate_of(n), anywhere, any_voxel);
    Replay replay(view, shape, gate_of(n));
    for (;;) {
      std::vector<Sortie> sorties;
      for (int planned = 0; planned < 3; ++planned) sorties.push_back(cuts.plan_sortie(5));
      if (sorties.front().cuts == 0) break;
      const std::size_t done = random.next() % 4;
      for (std::size_t at = 0; at < std::min(done, sorties.size()); ++at) {
        if (sorties[at].cuts > 0) {
          ASSERT_NO_FATAL_FAILURE(replay.run(sorties[at]));
        }
      }
      for (std::size_t later = sorties.size(); later-- > done;) cuts.take_back(sorties[later]);
      if (done >= sorties.size() || sorties[done].cuts == 0) continue;
      const Sortie& failed = sorties[done];
      const Stroke& culprit = failed.strokes[failed.serves[random.next() % failed.serves.size()]];
      cuts.give_up(culprit);
      for (int part = 0; part < culprit.count; ++part) left_out.insert(voxel_of(culprit, part));
    }
    ASSERT_EQ(count_within_reach(view, replay.standing(), list(replay.standing(), left_out)), 0u);
    removed += replay.removed();
  }
  EXPECT_GT(removed, 600u);
}

TEST(SlantedCuts, WhatMayNotBeTakenIsLeftAndTheRestIsCutAroundIt) {
  const int n = 8;
  std::size_t refused_of_all = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Shape shape = random_shape(n, seed);
    const ToolView view = tilted_views(n)[seed % 12];
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ", axis " << view.axis().transpose());
    Random random(seed);
    VoxelSet left_out = shape.keep;
    SlantedCuts cuts(view, shape.stock, list(shape.stock, shape.keep), gate_of(n), anywhere, [&](Voxel v) {
      EXPECT_FALSE(left_out.contains(v)) << "asked again";
      if (random.next() % 4 > 0) return true;
      left_out.insert(v);
      ++refused_of_all;
      return false;
    });
    Replay replay(view, shape, gate_of(n));
    for (Sortie sortie = cuts.plan_sortie(20); sortie.cuts > 0; sortie = cuts.plan_sortie(20)) {
      ASSERT_NO_FATAL_FAILURE(replay.run(sortie));
    }
    for_each_voxel(left_out, [&](Voxel v) { ASSERT_EQ(replay.standing().contains(v), shape.stock.contains(v)); });
    ASSERT_EQ(count_within_reach(view, replay.standing(), list(replay.standing(), left_out)), 0u);
  }
  EXPECT_GT(refused_of_all, 100u);
}

TEST(SlantedCuts, KeepToWhereTheBallMayBe) {
  const int n = 16;
  for (const ToolView& view : tilted_views(n)) {
    // A half of the grid that can be left along the axis, and all above it.
    const auto may_be = [&](const Vec3& cell) {
      return cell.z() > n - 0.5 || (view.lean.j == 0 ? cell.y() < 7.25 : cell.y() > 7.75);
    };
    const Shape shape{VoxelSet(n, true), VoxelSet(n)};
    SlantedCuts cuts(view, shape.stock, list(shape.stock, shape.keep), gate_of(n), may_be, any_voxel);
    Replay replay(view, shape, gate_of(n));
    Vec3 at(n / 2, n / 2, n + 1);
    for (Sortie sortie = cuts.plan_sortie(100); sortie.cuts > 0; sortie = cuts.plan_sortie(100)) {
      ASSERT_NO_FATAL_FAILURE(replay.run(sortie));
      for (const Stroke& stroke : sortie.strokes) {
        for (double t = 0; t <= 1; t += 1.0 / 64) {
          const Vec3 here = at + t * (stroke.to - at);
          // The plan looks at places half a cell apart; whether a line is usable all along is asked when it is
          // followed.
          ASSERT_TRUE(may_be(here) || may_be(here - Vec3(0, 0.5, 0)) || may_be(here + Vec3(0, 0.5, 0.5)))
              << here.transpose();
        }
        at = stroke.to;
      }
    }
    EXPECT_GT(replay.removed(), 100u);
    EXPECT_LE(replay.removed(), 8u * n * n);
  }
}

}  // namespace
}  // namespace sculpt
