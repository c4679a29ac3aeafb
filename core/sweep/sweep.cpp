#include "core/sweep/sweep.hpp"

#include <algorithm>
#include <optional>

#include "core/base/parallel.hpp"
#include "core/motion/tool_axes.hpp"
#include "core/motion/tool_reach.hpp"
#include "core/sweep/columns.hpp"
#include "core/sweep/directions.hpp"
#include "core/sweep/straight_pass.hpp"
#include "core/sweep/tilted_pass.hpp"

namespace sculpt {
namespace {

/// Voxels that make a field of a tilted direction, and the way there and back, worth their while.
constexpr std::uint64_t fewest_tilted = 4;

/// Chooses the direction of the next pass, until none cuts anything.
class Sweep {
 public:
  Sweep(Carving& carving, Directions& directions)
      : carving_(carving),
        directions_(directions),
        used_up_(directions.size()),
        spared_(directions.size()),
        counts_(directions.size()) {}

  SweepRest run() {
    do {
      std::fill_n(used_up_.begin(), directions_.straight(), 0);
      while (const auto direction = best_straight())
        end_pass(*direction, cut_straight(carving_, directions_.field(*direction), directions_.reach(*direction)));
    } while (carve_tilted());
    carving_.arm.go_home();
    return {carving_.support.standing(), std::move(*out_of_reach_)};
  }

 private:
  const VoxelSet& standing() const { return carving_.support.standing(); }

  void end_pass(std::size_t direction, const PassEnd& end) {
    used_up_[direction] = !end.cut;
    spared_[direction] = end.spared;
    if (!end.cut) return;
    // What was spared lest a piece come free may now be cut.
    for (std::size_t other = 0; other < used_up_.size(); ++other) used_up_[other] = used_up_[other] && !spared_[other];
  }

  std::optional<std::size_t> best_straight() {
    return best(0, directions_.straight(), 1, [this](std::size_t direction) {
      return Columns(directions_.view(direction), standing(), carving_.keep, directions_.reach(direction))
          .count_cuttable();
    });
  }

  /// Along tilted directions what no straight one came to. False if nothing was cut.
  bool carve_tilted() {
    if (!out_of_reach_) find_wanted();
    bool cut = false;
    while (const auto direction = best_tilted()) {
      const PassEnd end = cut_tilted(carving_, directions_.field(*direction), wanted_);
      end_pass(*direction, end);
      cut |= end.cut;
    }
    return cut;
  }

  void find_wanted() {
    VoxelSet rest = standing();
    rest -= carving_.keep;
    for_each_voxel(rest, [&](Voxel v) { wanted_.push_back(v); });
    const Scene& scene = carving_.scene;
    const double length = scene.tool().stickout_m / scene.grid().voxel_m;
    out_of_reach_ = find_out_of_tool_reach(standing(), wanted_, tool_steps(), length, carving_.watch);
    for (const Voxel v : *out_of_reach_) rest.erase(v);
    std::erase_if(wanted_, [&](Voxel v) { return !rest.contains(v); });
  }

  std::optional<std::size_t> best_tilted() {
    std::erase_if(wanted_, [&](Voxel v) { return !standing().contains(v); });
    if (wanted_.size() < fewest_tilted) return std::nullopt;
    return best(directions_.straight(), directions_.size(), fewest_tilted,
                [this](std::size_t direction) { return count_tilted(direction); });
  }

  std::uint64_t count_tilted(std::size_t direction) const {
    const ToolView& view = directions_.view(direction);
    std::vector<Voxel> wanted = wanted_;
    std::erase_if(wanted, [&](Voxel v) {
      const Voxel cell = view.cell(v);
      return !directions_.may_reach(direction, Vec3(cell.i, cell.j, cell.k));
    });
    const double all_through = 2.0 * view.n;
    return wanted.size() -
           find_out_of_tool_reach(standing(), wanted, {view.along(view.lean)}, all_through, carving_.watch).size();
  }

  /// The direction, of those from `first` to before `end` that are not used up, along which most can be cut now, if
  /// that is `fewest` voxels or more.
  template <typename Count>
  std::optional<std::size_t> best(std::size_t first, std::size_t end, std::uint64_t fewest, const Count& count) {
    for_each_index(carving_.threads, end - first,
                   [&](std::size_t at) { counts_[first + at] = used_up_[first + at] ? 0 : count(first + at); });
    const auto begin = counts_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto most = std::max_element(begin, counts_.begin() + static_cast<std::ptrdiff_t>(end));
    if (*most < fewest) return std::nullopt;
    return static_cast<std::size_t>(most - counts_.begin());
  }

  Carving& carving_;
  Directions& directions_;
  std::vector<char> used_up_;          ///< per direction: the last pass along it cut nothing
  std::vector<char> spared_;           ///< in the last pass along it something was left lest a piece come free
  std::vector<std::uint64_t> counts_;  ///< what could be cut along it when that was last asked
  std::vector<Voxel> wanted_;          ///< of what straight directions left, what tilted ones might cut
  std::optional<std::vector<Voxel>> out_of_reach_;  ///< what no direction can, once that was asked
};

}  // namespace

SweepRest carve_by_sweeps(const Scene& scene, const VoxelGrid& voxels, const VoxelSet& may_fall,
                          const Configuration& home, std::uint64_t seed, int threads,
                          const std::function<void(std::vector<Keyframe>)>& emit, const Watch& watch) {
  Directions directions(scene, home, seed, threads, watch);
  std::optional<Support> support;
  for_each_index(threads, 2, [&](std::size_t task) {
    if (task == 0)
      directions.find_straight_fields();
    else
      support.emplace(voxels.stock, may_fall);
  });
  Carving carving{scene, voxels.keep, threads, watch, std::move(*support), {scene, home, seed, emit, watch}};
  return Sweep(carving, directions).run();
}

}  // namespace sculpt
