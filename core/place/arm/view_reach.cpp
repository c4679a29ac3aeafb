#include "core/place/arm/view_reach.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "core/cell/ik.hpp"

namespace sculpt {
namespace {

constexpr int along = sectors_along;
constexpr int layers = along + 1;  // the last one is above the grid
constexpr std::size_t all_places = static_cast<std::size_t>(along) * along * layers;
constexpr std::size_t tried_seeds = 12;
constexpr int max_branches = 5;
constexpr double same_branch = 0.3;     // rad or m: starts that are nearer to each other grow to the same
constexpr double max_joint_step = 0.8;  // rad or m, from one place to the next: else it is another branch
constexpr double close_m = 1e-6;
constexpr int lane_steps = 4;

std::size_t place_index(Voxel place) {
  return static_cast<std::size_t>(place.i + along * (place.j + along * place.k));
}

/// A configuration for each place that one start leads to.
struct Branch {
  std::array<std::optional<Configuration>, all_places> at;
  std::array<Hold, all_places> holds;
};

class ViewSearch {
 public:
  ViewSearch(const StandArm& arm, const ToolView& view)
      : arm_(arm),
        view_(view),
        sectors_(study_view(view)),
        straight_(l1(view.lean, {}) == 1),
        lanes_(arm.chain, view.axis()),
        free_lanes_(arm.free_chain, view.axis()),
        to_the_middle_{(arm.chain.lower() + arm.chain.upper()) / 2, 0.1} {
    found_.holds.fill(Hold::reach);
    for (int part = 1; part < 8; ++part) {
      const Voxel up{part & 1, part >> 1 & 1, part >> 2};
      if (up.i <= view_.lean.i && up.j <= view_.lean.j && up.k <= view_.lean.k) above_.push_back(up);
    }
  }

  ViewReach run() {
    const auto numbers = PostureSeeds::nearest(arm_.seed_poses, ball_box(), view_.axis(), lever_m(), tried_seeds);
    int grown = 0;
    for (const std::size_t seed : numbers) {
      if (grown == max_branches || all_held()) break;
      const Voxel place = nearest_place(arm_.seed_poses[seed].ball_m);
      const auto q = solve_ik(arm_.chain, {ball_m(place), view_.axis()}, arm_.seeds.configurations()[seed], settings());
      if (!q || is_known(place, *q)) continue;
      branches_.push_back(grow(lanes_, place, *q));
      take(branches_.back());
      ++grown;
    }
    if (std::ranges::find(found_.holds, Hold::reach) != found_.holds.end()) look_past_limits(numbers);
    return std::move(found_);
  }

 private:
  static ToolView study_view(const ToolView& view) {
    for (const ToolView& other : study_views(along))
      if (other.step == view.step && other.lean == view.lean) return other;
    return {};
  }
  static IkSettings settings() {
    IkSettings settings;
    settings.position_tolerance_m = close_m;
    settings.max_steps = 40;
    return settings;
  }

  Vec3 place_cell(Voxel place) const {
    const auto middle = [this](int at) { return sector_middle(at, view_.n); };
    return {middle(place.i), middle(place.j), place.k < along ? middle(place.k) : view_.n + 1.0};
  }
  Vec3 ball_m(Voxel place) const { return view_.ball_m(arm_.grid, place_cell(place)); }
  bool is_place(Voxel place) const {
    return place.i >= 0 && place.j >= 0 && place.k >= 0 && place.i < along && place.j < along &&
           place.k < (straight_ ? layers : along);
  }
  Eigen::AlignedBox3d ball_box() const {
    const Vec3 a = ball_m({0, 0, 0}), b = ball_m({along - 1, along - 1, along - 1});
    return {a.cwiseMin(b), a.cwiseMax(b)};
  }
  double lever_m() const { return arm_.chain.stickout_m() + arm_.grid.n * arm_.grid.voxel_m; }
  Voxel nearest_place(const Vec3& ball) const {
    const Vec3 voxels = (ball - arm_.grid.origin_m) / arm_.grid.voxel_m - Vec3::Constant(0.5);
    return sectors_.cell(sector_of(voxels, view_.n));
  }
  bool is_known(Voxel place, const Configuration& q) const {
    return std::ranges::any_of(branches_, [&](const Branch& branch) {
      const auto& other = branch.at[place_index(place)];
      return other && (q - *other).cwiseAbs().maxCoeff() < same_branch;
    });
  }
  bool all_held() const {
    return std::ranges::all_of(found_.holds, [](Hold hold) { return hold == Hold::held; });
  }

  /// From place to place, each from one beside it.
  Branch grow(const PostureLanes& lanes, Voxel start, const Configuration& q) const {
    Branch branch;
    branch.at[place_index(start)] = q;
    std::deque<std::pair<Voxel, Voxel>> queue;  // a place, and the one beside it that has a configuration
    const auto queue_beside = [&](Voxel place) {
      for (const Voxel step : face_steps)
        if (is_place(place + step) && !branch.at[place_index(place + step)]) queue.emplace_back(place + step, place);
    };
    queue_beside(start);
    spread(lanes, branch, queue, queue_beside);
    return branch;
  }

  template <typename QueueBeside>
  void spread(const PostureLanes& lanes, Branch& branch, std::deque<std::pair<Voxel, Voxel>>& queue,
              const QueueBeside& queue_beside) const {
    while (!queue.empty()) {
      std::vector<std::pair<Voxel, Voxel>> visits, again;
      PostureBatch batch;
      while (!queue.empty() && visits.size() < lane_count) {
        const auto [place, from] = queue.front();
        queue.pop_front();
        if (branch.at[place_index(place)]) continue;
        if (std::ranges::any_of(visits, [place = place](const auto& visit) { return visit.first == place; })) {
          again.emplace_back(place, from);
          continue;
        }
        batch.set(static_cast<int>(visits.size()), ball_m(place), *branch.at[place_index(from)]);
        visits.emplace_back(place, from);
      }
      queue.insert(queue.end(), again.begin(), again.end());
      for (int lane = static_cast<int>(visits.size()); lane < lane_count && !visits.empty(); ++lane)
        batch.set(lane, ball_m(visits[0].second), *branch.at[place_index(visits[0].second)]);
      lanes.solve(batch, lane_steps, &to_the_middle_);
      for (std::size_t at = 0; at < visits.size(); ++at) {
        if (!(batch.ball_off_m[at] < close_m && batch.top_off_m[at] < 10 * close_m)) continue;
        const auto& [place, from] = visits[at];
        const Configuration q = batch.q.get(static_cast<int>(at), arm_.chain.dof());
        if ((q - *branch.at[place_index(from)]).cwiseAbs().maxCoeff() > max_joint_step) continue;
        branch.at[place_index(place)] = q;
        queue_beside(place);
      }
    }
  }

  Hold hold_at(const Configuration& q) {
    arm_.chain.link_poses(q, poses_);
    switch (arm_.contacts.at(arm_.chain, q, poses_, arm_.block, last_contact_)) {
      case StandContact::links:
        return Hold::links;
      case StandContact::stock:
        return Hold::stock;
      default:
        return Hold::held;
    }
  }

  /// What it holds, by itself and all the way out; into what was found.
  void take(Branch& branch) {
    find_holds(branch);
    const Voxel middle{along / 2, along / 2, along};
    std::size_t held = 0;
    for (std::size_t at = 0; at < all_sectors; ++at) {
      found_.holds[at] = std::min(found_.holds[at], branch.holds[at]);
      held += branch.holds[at] == Hold::held;
    }
    const bool is_free_above = straight_ && branch.holds[place_index(middle)] == Hold::held;
    if (is_free_above && (held > max_held_ || !found_.above)) found_.above = branch.at[place_index(middle)];
    if (held <= max_held_) return;
    max_held_ = held;
    found_.low = found_.high = Configuration();
    for (const auto& q : branch.at)
      if (q) {
        found_.low = found_.low.size() == 0 ? *q : Configuration(found_.low.cwiseMin(*q));
        found_.high = found_.high.size() == 0 ? *q : Configuration(found_.high.cwiseMax(*q));
      }
  }

  /// From outside in, so that nothing is asked for behind what is not held.
  void find_holds(Branch& branch) {
    const std::array<bool, all_places> wanted = find_wanted();
    for (int k = layers - 1; k >= 0; --k)
      for (int j = along - 1; j >= 0; --j)
        for (int i = along - 1; i >= 0; --i) {
          const Voxel place{i, j, k};
          if (!is_place(place)) continue;
          Hold hold = branch.at[place_index(place)] ? Hold::held : Hold::reach;
          for (const Voxel up : above_)
            if (is_place(place + up)) hold = std::max(hold, branch.holds[place_index(place + up)]);
          if (hold == Hold::held)
            hold = wanted[place_index(place)] ? hold_at(*branch.at[place_index(place)]) : Hold::reach;
          branch.holds[place_index(place)] = hold;
        }
  }

  /// Places that no branch holds yet, and those on the way out from them.
  std::array<bool, all_places> find_wanted() const {
    std::array<bool, all_places> wanted{};
    for (int k = 0; k < layers; ++k)
      for (int j = 0; j < along; ++j)
        for (int i = 0; i < along; ++i) {
          const Voxel place{i, j, k};
          bool& here = wanted[place_index(place)];
          here = here || (k < along && found_.holds[place_index(place)] != Hold::held);
          for (const Voxel up : above_)
            if (here && is_place(place + up)) wanted[place_index(place + up)] = true;
        }
    return wanted;
  }

  /// Of sectors that no branch came to, those that one would if there were no joint limits.
  void look_past_limits(const std::vector<std::size_t>& numbers) {
    Branch free;
    std::deque<std::pair<Voxel, Voxel>> queue;
    const auto queue_beside = [&](Voxel place) {
      for (const Voxel step : face_steps)
        if (is_place(place + step) && !free.at[place_index(place + step)]) queue.emplace_back(place + step, place);
    };
    for (const Branch& branch : branches_)
      for (std::size_t at = 0; at < all_places; ++at)
        if (branch.at[at] && !free.at[at]) free.at[at] = branch.at[at];
    if (branches_.empty()) {
      IkSettings no_limits = settings();
      no_limits.respect_limits = false;
      const Voxel place = nearest_place(arm_.seed_poses[numbers.front()].ball_m);
      free.at[place_index(place)] =
          solve_ik(arm_.chain, {ball_m(place), view_.axis()}, arm_.seeds.configurations()[numbers.front()], no_limits);
    }
    for (int k = 0; k < along; ++k)
      for (int j = 0; j < along; ++j)
        for (int i = 0; i < along; ++i)
          if (free.at[place_index({i, j, k})]) queue_beside({i, j, k});
    spread(free_lanes_, free, queue, queue_beside);
    for (std::size_t at = 0; at < all_sectors; ++at)
      if (found_.holds[at] == Hold::reach && free.at[at]) found_.holds[at] = Hold::limits;
  }

  const StandArm& arm_;
  const ToolView& view_;
  ToolView sectors_;  ///< the same of the sectors
  bool straight_;
  PostureLanes lanes_, free_lanes_;
  NullSpaceGoal to_the_middle_;
  std::vector<Branch> branches_;
  std::vector<Voxel> above_;  ///< steps to the places through which the ball comes in
  std::size_t max_held_ = 0, last_contact_ = 0;
  std::vector<Frame> poses_;
  ViewReach found_;
};

}  // namespace

ViewReach find_view_reach(const StandArm& arm, const ToolView& view) {
  return ViewSearch(arm, view).run();
}

}  // namespace sculpt
