#include "core/doctor/probe_reach.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "core/base/random.hpp"
#include "core/cell/ik.hpp"
#include "core/doctor/body_names.hpp"
#include "core/motion/random_configuration.hpp"

namespace sculpt {
namespace {

constexpr int random_starts = 8, starts_beyond_limits = 3, starts_of_joint_reach = 3;

/// The centre of a voxel of the stock by shares of its edges.
Vec3 place_m(const Grid& grid, const Vec3& share) {
  const Vec3 cell = (share * (grid.n - 1)).array().round();
  return grid.centre({static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z())});
}

struct Direction {
  const char* name;
  Vec3 axis;
};

std::vector<Direction> directions_of(const Chain& chain, const Configuration& home) {
  if (chain.translating()) return {{"its only one", chain.tool_pose(home).axis}};
  return {{"+z", Vec3::UnitZ()},
          {"+x", Vec3::UnitX()},
          {"+y", Vec3::UnitY()},
          {"-x", -Vec3::UnitX()},
          {"-y", -Vec3::UnitY()}};
}

/// Looks for postures at one place after the other, in such an order that the last one is near.
class DirectionSearch {
 public:
  DirectionSearch(const Scene& scene, const Direction& direction, const Configuration& home, std::uint64_t seed)
      : scene_(scene), axis_(direction.axis), home_(home), random_(seed) {
    found_.name = direction.name;
    found_.axis = axis_;
  }

  /// True if the arm can be there.
  bool look_at(const Vec3& ball_m) {
    ++found_.places;
    std::optional<NearBodies> blocking;
    for (int start = 0; start < 2 + random_starts; ++start) {
      const auto q = solve_ik(scene_.chain(), {ball_m, axis_}, start_of(start));
      if (!q) continue;
      const auto block = scene_.blocking_links(*q);
      if (!block) {
        last_ = *q;
        ++found_.free;
        return true;
      }
      if (!blocking) blocking = block;
    }
    if (blocking) {
      ++found_.blocked;
      ++blockers_[{blocking->first, blocking->second}];
    } else {
      ++(can_reach_beyond_limits(ball_m) ? found_.beyond_limits : found_.out_of_reach);
    }
    return false;
  }

  DirectionFinding finish() {
    for (const auto& [pair, count] : blockers_)
      found_.blockers.emplace_back(name_bodies(scene_.chain().robot(), pair.first, pair.second), count);
    std::stable_sort(found_.blockers.begin(), found_.blockers.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    return std::move(found_);
  }

 private:
  Configuration start_of(int start) {
    if (start == 0 && last_) return *last_;
    return start < 2 ? home_ : random_configuration(scene_.chain(), random_);
  }

  bool can_reach_beyond_limits(const Vec3& ball_m) {
    IkSettings anywhere;
    anywhere.respect_limits = false;
    for (int start = 0; start < starts_beyond_limits; ++start)
      if (solve_ik(scene_.chain(), {ball_m, axis_}, start == 0 ? home_ : random_configuration(scene_.chain(), random_),
                   anywhere))
        return true;
    return false;
  }

  const Scene& scene_;
  Vec3 axis_;
  Configuration home_;
  Random random_;
  std::optional<Configuration> last_;
  DirectionFinding found_;
  std::map<std::pair<int, int>, int> blockers_;
};

/// Boustrophedon over the lattice, from the top down.
std::vector<Vec3> lattice_places(const Grid& grid, int per_edge) {
  std::vector<Vec3> places;
  const int last = per_edge - 1;
  for (int k = last; k >= 0; --k)
    for (int j = 0; j <= last; ++j)
      for (int i = 0; i <= last; ++i) {
        const int row = k % 2 == 0 ? j : last - j;
        const int along = (k * per_edge + j) % 2 == 0 ? i : last - i;
        places.push_back(place_m(grid, Vec3(along, row, k) / last));
      }
  return places;
}

}  // namespace

double probe_reach(const Scene& scene, const Configuration& from, const Watch& watch) {
  constexpr std::array shares{0.5, 0.0, 1.0};
  const Vec3 axis = scene.chain().translating() ? scene.chain().tool_pose(from).axis : Vec3::UnitZ();
  int free = 0, probes = 0;
  for (const double x : shares)
    for (const double y : shares) {
      std::optional<Configuration> q = from;
      for (const double z : {1.0, 0.5, 0.0}) {
        watch.step(Stage::plan, 0, 0);
        ++probes;
        if (q) q = solve_ik(scene.chain(), {place_m(scene.grid(), {x, y, z}), axis}, *q);
        free += q && !scene.blocking_links(*q);
      }
    }
  return static_cast<double>(free) / probes;
}

int count_joint_reach(const Cell& cell, const Configuration& start) {
  const Chain chain = cell.chain();
  Random random(1);
  std::vector<Configuration> starts{start};
  for (int guess = 0; guess < starts_of_joint_reach; ++guess) starts.push_back(random_configuration(chain, random));
  int reached = 0;
  for (const Direction& direction : directions_of(chain, start))
    for (int place = 0; place < 9; ++place) {
      const Vec3 share = place == 8 ? Vec3::Constant(0.5) : Vec3(place & 1, place >> 1 & 1, place >> 2 & 1);
      const IkGoal goal{cell.stock_origin_m + cell.stock_size_m * share, direction.axis};
      reached += std::any_of(starts.begin(), starts.end(),
                             [&](const Configuration& from) { return solve_ik(chain, goal, from).has_value(); });
    }
  return reached;
}

Reach find_reach(const Scene& scene, const Configuration& home, int per_edge, const RunContext& run) {
  const std::vector<Direction> directions = directions_of(scene.chain(), home);
  const std::vector<Vec3> places = lattice_places(scene.grid(), per_edge);
  std::vector<std::vector<char>> free(directions.size(), std::vector<char>(places.size()));
  Reach reach;
  reach.directions.resize(directions.size());
  run.helpers.for_each_index(directions.size(), [&](std::size_t d) {
    DirectionSearch search(scene, directions[d], home, mix(run.seed, d));
    for (std::size_t place = 0; place < places.size(); ++place) {
      run.watch.step(Stage::plan, place, places.size());
      free[d][place] = search.look_at(places[place]);
    }
    reach.directions[d] = search.finish();
  });
  std::size_t reached = 0;
  for (std::size_t place = 0; place < places.size(); ++place)
    reached += std::any_of(free.begin(), free.end(), [&](const auto& of) { return of[place] != 0; });
  reach.reached = static_cast<double>(reached) / static_cast<double>(places.size());
  return reach;
}

}  // namespace sculpt
