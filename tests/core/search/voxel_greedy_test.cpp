// Whether each step of the voxel search is the one that the paper's heuristic asks for, by brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <string_view>

#include "core/search/voxel_search.hpp"
#include "tests/core/search/replay.hpp"

namespace sculpt {
namespace {

struct Cut {
  Voxel from, voxel;  ///< where the robot stood after the last cut, and what it cut next
  int travelled = 0;  ///< steps between
};

std::vector<Cut> cuts_of(const VoxelGrid& voxels) {
  std::vector<Cut> cuts;
  Cut next{translating_entry(voxels.n()), {}, 0};
  const auto on_run = [&](const VoxelRun& run) {
    if (!run.cut) {
      next.travelled += l1(run.first, run.last);
      return;
    }
    const int length = std::max(l1(run.first, run.last), 1);
    const Voxel way = run.last - run.first, step{way.i / length, way.j / length, way.k / length};
    for (Voxel v = run.first;; v = v + step) {
      next.voxel = v;
      cuts.push_back(next);
      next = {v, {}, 0};
      if (v == run.last) return;
    }
  };
  carve_voxelwise(voxels, on_run, {});
  return cuts;
}

/// The number of its 6-connected section for every remove voxel.
std::map<Voxel, int> sections_of(const VoxelGrid& voxels) {
  const Grid grid{voxels.n(), 1, Vec3::Zero()};
  std::map<Voxel, int> sections;
  int count = 0;
  for (int cell = 0; cell < grid.n * grid.n * grid.n; ++cell) {
    std::vector<Voxel> stack{{cell % grid.n, cell / grid.n % grid.n, cell / grid.n / grid.n}};
    if (voxels.label(stack[0]) != Label::remove || !sections.try_emplace(stack[0], count).second) continue;
    while (!stack.empty()) {
      const Voxel v = stack.back();
      stack.pop_back();
      for (Voxel step : face_steps)
        if (grid.contains(v + step) && voxels.label(v + step) == Label::remove &&
            sections.try_emplace(v + step, count).second)
          stack.push_back(v + step);
    }
    ++count;
  }
  return sections;
}

/// Plays the cuts and knows at each what is left.
class Game {
 public:
  explicit Game(const VoxelGrid& voxels) : voxels_(voxels), left_(sections_of(voxels)) {}

  void check(const Cut& cut) {
    const int section = left_.at(cut.voxel);
    if (section != running_)
      check_start(cut.voxel, section);
    else
      check_step(cut, section);
    running_ = section;
    left_.erase(cut.voxel);
  }

 private:
  bool is_left(Voxel v, int section) const {
    const auto found = left_.find(v);
    return found != left_.end() && found->second == section;
  }
  int count_left(Voxel v, int section) const {
    return static_cast<int>(
        std::count_if(face_steps.begin(), face_steps.end(), [&](Voxel step) { return is_left(v + step, section); }));
  }
  bool is_air(Voxel v) const {
    const int n = voxels_.n();
    if (v.i < -1 || v.j < -1 || v.k < 0 || v.i > n || v.j > n || v.k > n) return false;
    if (!Grid{n, 1, Vec3::Zero()}.contains(v)) return true;
    return voxels_.label(v) != Label::keep && !left_.contains(v);
  }

  int steps_to_nearest(Voxel from, int section) const {
    std::map<Voxel, int> steps{{from, 0}};
    std::deque<Voxel> queue{from};
    while (count_left(queue.front(), section) == 0) {
      const Voxel at = queue.front();
      queue.pop_front();
      for (Voxel step : face_steps)
        if (is_air(at + step) && steps.try_emplace(at + step, steps[at] + 1).second) queue.push_back(at + step);
    }
    return steps[queue.front()];
  }

  void check_step(const Cut& cut, int section) const {
    if (count_left(cut.from, section) == 0) {
      ASSERT_EQ(cut.travelled, steps_to_nearest(cut.from, section));
      return;
    }
    ASSERT_EQ(cut.travelled, 0);
    for (Voxel step : face_steps) {
      const bool better = is_left(cut.from + step, section) && count_left(cut.from + step, section) > 0;
      ASSERT_FALSE(better && count_left(cut.voxel, section) == 0) << "a move with less h was there";
    }
  }

  int to_corner(Voxel v) const {
    const int last = voxels_.n() - 1;
    return std::min(v.i, last - v.i) + std::min(v.j, last - v.j) + std::min(v.k, last - v.k);
  }

  void check_start(Voxel start, int section) const {
    const int last = voxels_.n() - 1;
    int least = 1 << 30;
    for (const auto& [v, owner] : left_) {
      ASSERT_NE(owner, running_) << "a section was left before it was done";
      const bool outer = std::min(v.i, v.j) == 0 || std::max({v.i, v.j, v.k}) == last;
      if (owner == section && outer) least = std::min(least, to_corner(v));
    }
    if (least == 1 << 30) return;
    const bool outer = std::min(start.i, start.j) == 0 || std::max({start.i, start.j, start.k}) == last;
    ASSERT_TRUE(outer);
    ASSERT_EQ(to_corner(start), least);
  }

  const VoxelGrid& voxels_;
  std::map<Voxel, int> left_;
  int running_ = -1;
};

TEST(VoxelGreedy, EveryCutHasTheLeastHEveryWayIsShortestAndEverySectionIsDoneBeforeTheNext) {
  int ways = 0, sections = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const VoxelGrid voxels = random_voxels(8, seed);
    Game game(voxels);
    for (const Cut& cut : cuts_of(voxels)) {
      game.check(cut);
      if (HasFatalFailure()) return;
      ways += cut.travelled > 0;
    }
    for (const auto& [voxel, section] : sections_of(voxels)) sections = std::max(sections, section + 1);
  }
  EXPECT_GT(ways, 1000) << "the random shapes are too simple";
  EXPECT_GT(sections, 5) << "no random shape falls apart into sections any more";
}

/// One layer inside solid keep, so that there is no way over it: the 2D figure as a 3D grid. Dots are to be removed.
VoxelGrid figure(const std::array<std::string_view, 8>& rows) {
  VoxelGrid voxels{VoxelSet(8, true), VoxelSet(8, true)};
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 8; ++i)
      if (rows[j][i] == '.') voxels.keep.erase({i, j, 4});
  return voxels;
}

/// Figure 3 of the paper: whichever arm of the ring is cut first, it ends in front of a wall with the end of the other
/// arm right behind it. Every step from there leads away from the nearest voxel, back to the fork.
TEST(VoxelGreedy, TheStuckStateOfThePaperIsLeftByTheShortestWayBack) {
  const VoxelGrid voxels = figure({"########",  //
                                   "#.....##",  //
                                   "#.###.##",  //
                                   "..###.##",  //
                                   "#.###.##",  //
                                   "#.###.##",  //
                                   "#...#.##",  //
                                   "########"});
  const std::map<Voxel, int> back{{{5, 6, 4}, 11}, {{3, 6, 4}, 5}};  // steps from the end of an arm to the fork
  const std::vector<Cut> cuts = cuts_of(voxels);
  ASSERT_EQ(cuts.size(), 18u);
  int stuck = 0;
  for (std::size_t c = 1; c < cuts.size(); ++c) {
    if (cuts[c].travelled == 0) continue;
    ++stuck;
    ASSERT_TRUE(back.contains(cuts[c].from));
    EXPECT_EQ(cuts[c].travelled, back.at(cuts[c].from));
    EXPECT_EQ(l1(cuts[c].voxel, {1, 3, 4}), 1) << "beside the fork";
  }
  EXPECT_EQ(stuck, 1);
}

}  // namespace
}  // namespace sculpt
