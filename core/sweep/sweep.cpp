#include "core/sweep/sweep.hpp"

#include <algorithm>
#include <utility>

#include "core/base/helpers.hpp"
#include "core/motion/tool/tool_axes.hpp"
#include "core/motion/tool/tool_reach.hpp"
#include "core/sweep/columns.hpp"
#include "core/sweep/directions.hpp"
#include "core/sweep/straight_pass.hpp"
#include "core/sweep/tilted_pass.hpp"

namespace sculpt {
namespace {

/// Voxels that make a field of a tilted direction, and the way there and back, worth their while.
constexpr std::uint64_t fewest_tilted = 4;
/// Voxels that no field covers, that make opening fields worth their while.
constexpr std::uint64_t fewest_uncovered = 64;

/// Chooses the direction of the next pass, until none cuts anything.
class Sweep {
 public:
  Sweep(Carving& carving, Directions& directions, const std::function<void(const SweepMemory&)>& note)
      : carving_(carving), directions_(directions), note_(note), counts_(directions.size()) {
    now_.asked_with = standing().size();
    now_.used_up.resize(directions.size());
    now_.spared.resize(directions.size());
  }

  void resume(const SweepStart& start) {
    for (const Opening& opening : start.memory.openings) open(opening);
    now_ = start.memory;
    for (const std::size_t direction : now_.tilted_fields) directions_.field(direction);
    carving_.arm.resume(now_.arm, start.q, now_.direction ? &directions_.field(*now_.direction) : nullptr);
  }

  SweepRest run() {
    if (now_.pass) cut_along(*now_.direction, std::exchange(now_.pass, {}));
    while (cut_next()) {
    }
    carving_.arm.go_home();
    const SweepFigures figures = count();
    return {carving_.support.standing(), std::move(*now_.out_of_reach), figures};
  }

 private:
  const VoxelSet& standing() const { return carving_.support.standing(); }

  SweepFigures count() const {
    return {carving_.scene.material().solid().size() - standing().size(), find_wanted().size(),
            find_uncovered().size()};
  }

  /// Of what is left to cut, what the field of no direction that was found covers.
  VoxelSet find_uncovered() const {
    VoxelSet uncovered(standing().n());
    for (const Voxel v : find_wanted()) {
      bool is_covered = false;
      for (std::size_t direction = 0; direction < directions_.size() && !is_covered; ++direction)
        is_covered = directions_.is_found(direction) &&
                     directions_.may_reach(direction, ToolView::place(directions_.view(direction).cell(v)));
      if (!is_covered) uncovered.insert(v);
    }
    return uncovered;
  }

  /// Straight directions as long as they cut something, then tilted ones for what no straight one came to, and so on.
  /// False if nothing was cut along any since that was last begun.
  bool cut_next() {
    if (!now_.tilted) {
      if (const auto direction = best_straight()) {
        cut_along(*direction, {});
        return true;
      }
      if (open_more()) return true;
      now_.tilted = true;
      now_.cut_tilted = false;
      if (!now_.out_of_reach) find_out_of_reach();
    }
    const std::vector<Voxel> wanted = find_wanted();
    if (const auto direction = best_tilted(wanted)) {
      const PassEnd end = cut_tilted(carving_, directions_.field(*direction), wanted);
      now_.cut_tilted |= end.cut;
      end_pass(*direction, end);
      return true;
    }
    now_.tilted = false;
    for (std::size_t direction = 0; direction < directions_.size(); ++direction)
      if (directions_.is_straight(direction)) now_.used_up[direction] = false;
    return now_.cut_tilted;
  }

  void cut_along(std::size_t straight, const std::optional<StraightMark>& from) {
    end_pass(straight, cut_straight(carving_, directions_.field(straight), directions_.reach(straight), from,
                                    [this](const StraightMark& mark) { note(mark); }));
  }

  void end_pass(std::size_t direction, const PassEnd& end) {
    now_.used_up[direction] = !end.cut;
    now_.spared[direction] = end.spared;
    // What was spared lest a piece come free may now be cut.
    for (std::size_t other = 0; end.cut && other < now_.used_up.size(); ++other)
      now_.used_up[other] = now_.used_up[other] && !now_.spared[other];
    note({});
  }

  void note(const std::optional<StraightMark>& pass) {
    now_.tilted_fields = directions_.tilted_found();
    now_.arm = carving_.arm.memory();
    now_.direction.reset();
    if (const PostureField* field = carving_.arm.field()) now_.direction = directions_.number_of(*field);
    now_.pass = pass;
    note_(now_);
    now_.pass.reset();
  }

  /// With what was cut out of the way of links, if that is anything since it was last asked.
  bool open_more() {
    const std::uint64_t standing_voxels = standing().size();
    if (std::exchange(now_.asked_with, standing_voxels) == standing_voxels) return false;
    if (!now_.out_of_reach) find_out_of_reach();
    const VoxelSet uncovered = find_uncovered();
    if (uncovered.size() < fewest_uncovered) return false;
    Opening opening{Directions::blocks_of(standing()), Directions::blocks_of(uncovered)};
    if (!open(opening)) return false;
    now_.openings.push_back(std::move(opening));
    return true;
  }

  bool open(const Opening& opening) {
    if (!directions_.open(opening)) return false;
    now_.used_up.resize(directions_.size());
    now_.spared.resize(directions_.size());
    counts_.resize(directions_.size());
    return true;
  }

  std::optional<std::size_t> best_straight() {
    return best(true, 1, [this](std::size_t direction) {
      return Columns(directions_.view(direction), standing(), carving_.keep, directions_.reach(direction))
          .count_cuttable();
    });
  }

  void find_out_of_reach() {
    VoxelSet rest = standing();
    rest -= carving_.keep;
    std::vector<Voxel> wanted;
    for_each_voxel(rest, [&](Voxel v) { wanted.push_back(v); });
    const Scene& scene = carving_.scene;
    const double length = scene.tool().stickout_m / scene.grid().voxel_m;
    now_.out_of_reach = find_out_of_tool_reach(standing(), wanted, tool_steps(), length, carving_.run.watch);
  }

  /// Of what straight directions left, what tilted ones might cut.
  std::vector<Voxel> find_wanted() const {
    VoxelSet rest = standing();
    rest -= carving_.keep;
    for (const Voxel v : *now_.out_of_reach) rest.erase(v);
    std::vector<Voxel> wanted;
    for_each_voxel(rest, [&](Voxel v) { wanted.push_back(v); });
    return wanted;
  }

  std::optional<std::size_t> best_tilted(const std::vector<Voxel>& wanted) {
    if (wanted.size() < fewest_tilted) return std::nullopt;
    return best(false, fewest_tilted, [&](std::size_t direction) { return count_tilted(direction, wanted); });
  }

  std::uint64_t count_tilted(std::size_t direction, std::vector<Voxel> wanted) const {
    const ToolView& view = directions_.view(direction);
    std::erase_if(wanted, [&](Voxel v) { return !directions_.may_reach(direction, ToolView::place(view.cell(v))); });
    const double all_through = 2.0 * view.n;
    return wanted.size() -
           find_out_of_tool_reach(standing(), wanted, {view.along(view.lean)}, all_through, carving_.run.watch).size();
  }

  /// The direction, of the straight or the tilted ones that are not used up, along which most can be cut now, if that
  /// is `fewest` voxels or more.
  template <typename Count>
  std::optional<std::size_t> best(bool straight, std::uint64_t fewest, const Count& count) {
    carving_.run.helpers.for_each_index(counts_.size(), [&](std::size_t at) {
      counts_[at] = directions_.is_straight(at) != straight || now_.used_up[at] ? 0 : count(at);
    });
    const auto most = std::ranges::max_element(counts_);
    if (*most < fewest) return std::nullopt;
    return static_cast<std::size_t>(most - counts_.begin());
  }

  Carving& carving_;
  Directions& directions_;
  const std::function<void(const SweepMemory&)>& note_;
  SweepMemory now_;
  std::vector<std::uint64_t> counts_;  ///< what could be cut along each direction when that was last asked
};

/// What a support knows depends on what stood first and what stands now, not on the order in between.
void remove_cut(Support& support, const VoxelSet& standing) {
  VoxelSet cut = support.standing();
  cut -= standing;
  for_each_voxel(cut, [&](Voxel v) { support.remove(v); });
}

}  // namespace

SweepRest carve_by_sweeps(const Scene& scene, const SweepTask& task, const std::optional<SweepStart>& start,
                          const SweepListener& listener, const RunContext& run) {
  Directions directions(scene, task.home, run, task.fields);
  std::optional<Support> support;
  run.helpers.for_each_index(2, [&](std::size_t part) {
    if (part == 0) {
      directions.find_straight_fields();
    } else {
      support.emplace(task.voxels.stock, task.may_fall);
      if (start) remove_cut(*support, start->standing);
    }
  });
  HubArm arm(scene, task.home, directions.stock_turn(), run.seed, listener.emit, run.watch);
  Carving carving{scene, task.voxels.keep, run, std::move(*support), std::move(arm)};
  Sweep sweep(carving, directions, listener.note);
  if (start) sweep.resume(*start);
  listener.ready();
  return sweep.run();
}

}  // namespace sculpt
