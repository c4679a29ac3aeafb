#include "core/search/voxel_search.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "core/material/cavities.hpp"
#include "core/search/voxel_sections.hpp"
#include "core/search/voxel_space.hpp"
#include "core/search/voxel_tree.hpp"

namespace sculpt {
namespace {

class VoxelSearch {
 public:
  VoxelSearch(const VoxelGrid& voxels, const Ground& ground, RunWriter& writer, const Watch& watch)
      : grid_{voxels.n(), 1, Vec3::Zero()},
        watch_(watch),
        end_(ground.end),
        space_(voxels),
        waiting_(grid_.n),
        section_(grid_.n),
        left_(grid_.n),
        writer_(writer),
        at_(space_.index(writer_.at())) {
    for (const Voxel position : ground.closed) space_.close(position);
    for (const auto& [from, to] : ground.blocked) space_.block(from, to);
    if (ground.support != nullptr) support_.emplace(*ground.support);
    const VoxelSet enclosed = find_enclosed(voxels);
    for (int k = 0; k < grid_.n; ++k)
      for (int j = 0; j < grid_.n; ++j)
        for (int i = 0; i < grid_.n; ++i)
          if (voxels.label({i, j, k}) == Label::remove && !enclosed.contains({i, j, k})) await({i, j, k});
  }

  void run() {
    do {
      while (!waiting_.empty() && begin_section()) carve_section();
    } while (try_again());
    travel(way_to(end_, 0).value());
    writer_.finish();
    watch_.step(Stage::plan, removed_, total_);
  }

 private:
  using Way = std::vector<std::uint8_t>;

  void await(Voxel v) {
    waiting_.insert(v);
    left_.insert(v);
    ++total_;
  }

  void tick() {
    constexpr unsigned steps_a_report = 256;
    if (++ticks_ % steps_a_report == 0) watch_.step(Stage::plan, removed_, total_);
  }

  /// The nearest section by way is next. It is begun on an outer face; one that has no voxel there lies at air that was
  /// there at the start, and is begun where the robot comes to it. False if there is no way to any.
  bool begin_section() {
    const std::optional<Way> way = way_to(waiting_);
    if (!way) {
      waiting_ = VoxelTree(grid_.n);
      return false;
    }
    const Voxel door = end_of(*way);
    const Voxel seed = door + *std::find_if(face_steps.begin(), face_steps.end(), [&](Voxel step) {
                         return grid_.contains(door + step) && waiting_.contains(door + step);
                       });
    const std::vector<Voxel> outer = take_section(grid_.n, seed, waiting_, section_, [this] { tick(); });
    const Voxel start = outer.empty() ? seed : find_start(grid_.n, outer, writer_.at());
    const std::optional<Way> there = outer.empty() ? way : way_to(start, 1);
    if (!there) return true;
    const int face = face_to(end_of(*there), start);
    if (!can_cut(end_of(*there), face)) return true;
    travel(*there);
    cut(face);
    return true;
  }

  void carve_section() {
    while (!section_.empty()) {
      tick();
      if (const auto face = choose_cut())
        cut(*face);
      else if (!go_on())
        return;
    }
  }

  /// To where the next voxel of the section can be cut. What is beside the way's end and cannot is set aside.
  bool go_on() {
    while (!section_.empty()) {
      const std::optional<Way> way = way_to(section_);
      if (!way) {
        section_ = VoxelTree(grid_.n);
        is_aside_ = true;
        return false;
      }
      const Voxel door = end_of(*way);
      bool any = false;
      for (int face = 0; face < 6; ++face) {
        const Voxel voxel = door + face_steps[face];
        if (!grid_.contains(voxel) || !section_.contains(voxel)) continue;
        const bool can = can_cut(door, face);
        any |= can;
        if (can) continue;
        section_.erase(voxel);
        is_aside_ = true;
      }
      if (!any) continue;
      travel(*way);
      return true;
    }
    return false;
  }

  /// What is left and would free nothing now, if anything was cut since that was last asked.
  bool try_again() {
    if (!std::exchange(cut_since_, false) || !is_aside_) return false;
    for_each_voxel(left_, [&](Voxel v) {
      if (!support_ || !support_->frees(v)) waiting_.insert(v);
    });
    return !waiting_.empty();
  }

  bool can_cut(Voxel from, int face) const {
    return !space_.is_blocked(space_.index(from), face) && !(support_ && support_->frees(from + face_steps[face]));
  }

  static int face_to(Voxel from, Voxel to) {
    return static_cast<int>(std::find(face_steps.begin(), face_steps.end(), to - from) - face_steps.begin());
  }

  Voxel end_of(const Way& way) const {
    Voxel end = writer_.at();
    for (int face : way) end = end + face_steps[face];
    return end;
  }

  /// To where a voxel of `set` is beside the robot.
  std::optional<Way> way_to(const VoxelTree& set) {
    std::optional<Voxel> last;
    return space_.find_way(at_, 1, [&](Voxel from, int most) {
      tick();
      const int known = last ? std::min(most, l1(*last, from)) : most;
      if (known <= most - 2) return known;  // nothing can be nearer than one step less than at the voxel before
      const auto nearer = set.nearest_about(from, known);
      if (!nearer) return known;
      last = nearer->corner;
      return nearer->distance;
    });
  }

  std::optional<Way> way_to(Voxel target, int enough) {
    return space_.find_way(at_, enough, [&](Voxel from, int) {
      tick();
      return l1(from, target);
    });
  }

  /// Layers of the grid between a voxel and the outside, which is not below it.
  int depth(Voxel v) const {
    const int last = grid_.n - 1;
    return std::min({v.i, last - v.i, v.j, last - v.j, last - v.k});
  }

  /// Of the moves that remove a voxel the one with the least h. They leave the same number of voxels, so h differs by
  /// the L1 term only: 1 where a voxel follows, more where none does. The paper leaves ties open. A voxel with a single
  /// neighbour left comes first, as it would be left behind alone otherwise (after Warnsdorff's rule for the knight's
  /// tour), then outer layers, then z before y before x, which keeps rows parallel. Fewest neighbours throughout saves
  /// a few moves more and turns two to three times as often.
  std::optional<int> choose_cut() const {
    std::optional<int> best;
    std::tuple<bool, bool, int> least;
    for (int face = 5; face >= 0; --face) {
      const VoxelSpace::Index next = space_.beside(at_, face);
      const Voxel voxel = writer_.at() + face_steps[face];
      if (!space_.is_remove(next) || !section_.contains(voxel)) continue;
      const int left = space_.count_remove(next);
      const std::tuple rank(left == 0, left > 1, depth(voxel));
      if ((best && rank >= least) || !can_cut(writer_.at(), face)) continue;
      best = face;
      least = rank;
    }
    return best;
  }

  void cut(int face) {
    const Voxel voxel = writer_.at() + face_steps[face];
    at_ = space_.beside(at_, face);
    space_.open(at_);
    section_.erase(voxel);
    left_.erase(voxel);
    if (support_) support_->remove(voxel);
    if (is_aside_) take_back_beside(voxel);
    cut_since_ = true;
    writer_.cut(voxel, voxel);
    ++removed_;
  }

  /// What was set aside beside a voxel that is gone: a piece can be cut from its free end.
  void take_back_beside(Voxel voxel) {
    for (const Voxel step : face_steps) {
      const Voxel beside = voxel + step;
      if (grid_.contains(beside) && left_.contains(beside) && !waiting_.contains(beside) && !section_.contains(beside))
        section_.insert(beside);
    }
  }

  void travel(const Way& way) {
    for (int face : way) {
      at_ = space_.beside(at_, face);
      writer_.travel(writer_.at() + face_steps[face]);
    }
  }

  Grid grid_;
  const Watch& watch_;
  Voxel end_;
  VoxelSpace space_;
  VoxelTree waiting_;  ///< in sections that are not begun
  VoxelTree section_;  ///< what is left of the running one
  VoxelSet left_;      ///< of all; what is in neither of the two was set aside
  std::optional<Support> support_;
  bool is_aside_ = false, cut_since_ = false;
  RunWriter& writer_;
  VoxelSpace::Index at_;  ///< where the writer is
  unsigned ticks_ = 0;
  std::uint64_t removed_ = 0, total_ = 0;
};

}  // namespace

void carve_voxelwise(const VoxelGrid& voxels, const Ground& ground, const std::function<void(const VoxelRun&)>& emit,
                     const Watch& watch) {
  RunWriter writer(ground.start, emit);
  carve_voxelwise(voxels, ground, writer, watch);
}

void carve_voxelwise(const VoxelGrid& voxels, const Ground& ground, RunWriter& writer, const Watch& watch) {
  VoxelSearch(voxels, ground, writer, watch).run();
}

void carve_voxelwise(const VoxelGrid& voxels, const std::function<void(const VoxelRun&)>& emit, const Watch& watch) {
  const Voxel entry = translating_entry(voxels.n());
  carve_voxelwise(voxels, {entry, entry}, emit, watch);
}

}  // namespace sculpt
