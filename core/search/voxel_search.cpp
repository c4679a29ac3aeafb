#include "core/search/voxel_search.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "core/material/cavities.hpp"
#include "core/search/run_writer.hpp"
#include "core/search/voxel_sections.hpp"
#include "core/search/voxel_space.hpp"
#include "core/search/voxel_tree.hpp"

namespace sculpt {
namespace {

class VoxelSearch {
 public:
  VoxelSearch(const VoxelGrid& voxels, const std::function<void(const VoxelRun&)>& emit, const Watch& watch)
      : grid_{voxels.n(), 1, Vec3::Zero()},
        watch_(watch),
        space_(voxels),
        waiting_(grid_.n),
        section_(grid_.n),
        writer_(translating_entry(grid_.n), emit),
        at_(space_.index(writer_.at())) {
    const VoxelSet enclosed = find_enclosed(voxels);
    for (int k = 0; k < grid_.n; ++k)
      for (int j = 0; j < grid_.n; ++j)
        for (int i = 0; i < grid_.n; ++i)
          if (voxels.label({i, j, k}) == Label::remove && !enclosed.contains({i, j, k})) await({i, j, k});
  }

  void run() {
    while (!waiting_.empty()) {
      begin_section();
      while (!section_.empty()) {
        tick();
        if (const auto face = choose_cut())
          cut(*face);
        else
          travel(way_to(section_));
      }
    }
    travel(way_to(translating_entry(grid_.n), 0));
    writer_.finish();
    watch_.step(Stage::plan, removed_, total_);
  }

 private:
  using Way = std::vector<std::uint8_t>;

  void await(Voxel v) {
    waiting_.insert(v);
    ++total_;
  }

  void tick() {
    constexpr unsigned steps_a_report = 256;
    if (++ticks_ % steps_a_report == 0) watch_.step(Stage::plan, removed_, total_);
  }

  /// The nearest section by way is next. It is begun on an outer face; one that has no voxel there lies at air that was
  /// there at the start, and is begun where the robot comes to it.
  void begin_section() {
    const Way way = way_to(waiting_);
    Voxel door = writer_.at();
    for (int face : way) door = door + face_steps[face];
    const Voxel seed = door + *std::find_if(face_steps.begin(), face_steps.end(), [&](Voxel step) {
                         return grid_.contains(door + step) && waiting_.contains(door + step);
                       });
    const std::vector<Voxel> outer = take_section(grid_.n, seed, waiting_, section_, [this] { tick(); });
    const Voxel start = outer.empty() ? seed : find_start(grid_.n, outer, writer_.at());
    travel(outer.empty() ? way : way_to(start, 1));
    cut(static_cast<int>(std::find(face_steps.begin(), face_steps.end(), start - writer_.at()) - face_steps.begin()));
  }

  /// To where a voxel of `set` is beside the robot. There must be a way, as for whatever is not enclosed.
  Way way_to(const VoxelTree& set) {
    return space_
        .find_way(at_, 1,
                  [&](Voxel from, int most) {
                    tick();
                    return set.distance(from, most);
                  })
        .value();
  }

  Way way_to(Voxel target, int enough) {
    return space_
        .find_way(at_, enough,
                  [&](Voxel from, int) {
                    tick();
                    return l1(from, target);
                  })
        .value();
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
      if (best && rank >= least) continue;
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
    writer_.cut(voxel, voxel);
    ++removed_;
  }

  void travel(const Way& way) {
    for (int face : way) {
      at_ = space_.beside(at_, face);
      writer_.travel(writer_.at() + face_steps[face]);
    }
  }

  Grid grid_;
  const Watch& watch_;
  VoxelSpace space_;
  VoxelTree waiting_;  ///< in sections that are not begun
  VoxelTree section_;  ///< what is left of the running one
  RunWriter writer_;
  VoxelSpace::Index at_;  ///< where the writer is
  unsigned ticks_ = 0;
  std::uint64_t removed_ = 0, total_ = 0;
};

}  // namespace

void carve_voxelwise(const VoxelGrid& voxels, const std::function<void(const VoxelRun&)>& emit, const Watch& watch) {
  VoxelSearch(voxels, emit, watch).run();
}

}  // namespace sculpt
