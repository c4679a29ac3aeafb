// How the arm could come in to a voxel from outside the stock. Nothing here moves it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/motion/arm.hpp"
#include "core/motion/line.hpp"

namespace sculpt {
namespace {

/// By effort, to start IK from: hubs, and postures of the atlas.
constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
constexpr std::size_t nearest_hubs[] = {3, all, all};
constexpr std::size_t known_postures[] = {2, 6, 16};

}  // namespace

std::size_t Arm::number_of(Voxel voxel, std::size_t axis) const {
  const auto n = static_cast<std::size_t>(scene_.grid().n);
  return ((voxel.k * n + voxel.j) * n + voxel.i) * axes().size() + axis;
}

Vec3 Arm::outside(const Vec3& ball_m, const Vec3& axis) const {
  const Grid& grid = scene_.grid();
  const double clear = scene_.tool().ball_radius_m + 0.3 * grid.voxel_m, side = grid.n * grid.voxel_m;
  double shortest = std::numeric_limits<double>::max();
  for (int i = 0; i < 3; ++i) {
    if (std::abs(axis[i]) < 1e-9) continue;
    const double face = axis[i] > 0 ? side + clear : -clear;
    shortest = std::min(shortest, (grid.origin_m[i] + face - ball_m[i]) / axis[i]);
  }
  return ball_m + std::max(0.0, shortest) * axis;
}

Vec3 Arm::beside(Voxel voxel, const Vec3& axis) const {
  // A ball of radius below h/2 is clear of the cube once its centre is h (straight) or 1.4 h (tilted: half a diagonal
  // and the radius) away.
  const double distance = axis.cwiseAbs().maxCoeff() > 1 - 1e-9 ? 1.0 : 1.4;
  return centre(voxel) + distance * scene_.grid().voxel_m * axis;
}

std::vector<Configuration> Arm::entry_seeds(Voxel voxel, std::size_t axis, int from_effort, int effort) const {
  const std::vector<Configuration> known = atlas_.around(voxel, axis, known_postures[effort]);
  if (known.empty()) return {};
  std::vector<Configuration> seeds;
  const auto add = [&](const std::vector<Configuration>& from, const std::size_t(&counts)[3]) {
    const std::size_t first = from_effort > 0 ? std::min(counts[from_effort - 1], from.size()) : 0;
    const std::size_t end = std::min(counts[effort], from.size());
    seeds.insert(seeds.end(), from.begin() + static_cast<std::ptrdiff_t>(first),
                 from.begin() + static_cast<std::ptrdiff_t>(std::max(first, end)));
  };
  if (axis == memory_.axis && from_effort == 0) seeds.push_back(q_);
  if (const auto at = memory_.hubs.find(axis); at != memory_.hubs.end()) {
    Path hubs = at->second;
    const Vec3 ball = outside(centre(voxel), axes()[axis]);
    std::ranges::stable_sort(
        hubs, {}, [&](const Configuration& q) { return (scene_.chain().tool_pose(q).ball_m - ball).norm(); });
    add(hubs, nearest_hubs);
  }
  if (from_effort == 0) seeds.push_back(home_);
  add(known, known_postures);
  return seeds;
}

std::optional<Arm::Entry> Arm::find_entry(Voxel voxel, std::size_t axis, const Configuration& seed) const {
  const Vec3& direction = axes()[axis];
  const auto q = solve_rounded(scene_.chain(), {centre(voxel), direction}, seed);
  if (!q || scene_.contact_at(*q, voxel) != Contact::none) return {};
  const auto first = solve_rounded(scene_.chain(), {beside(voxel, direction), direction}, *q);
  if (!first || scene_.certify(*first, *q, voxel) != Contact::none) return {};
  const auto rest = track_line(scene_, *first, outside(centre(voxel), direction), direction);
  if (!rest) return {};
  Path path{*first};
  path.insert(path.end(), rest->begin(), rest->end());
  return Entry{Path(path.rbegin(), path.rend()), *q};
}

void Arm::find_next_entry(Approach& approach) const {
  approach.entry.reset();
  while (!approach.entry && approach.tried < approach.seeds.size()) {
    if (run_.watch.stop.stop_requested()) throw Cancelled{};
    approach.entry = find_entry(approach.voxel, approach.axis, approach.seeds[approach.tried++]);
  }
}

void Arm::look_ahead(std::span<const Descent> descents, int effort) {
  looked_ahead_ = {memory_.cut, effort, {}};
  if (is_in_vain()) return;
  std::vector<Approach> approaches(descents.size());
  run_.helpers.for_each_index(descents.size(), [&](std::size_t i) { approaches[i] = look_at(descents[i], effort); });
  for (Approach& approach : approaches)
    looked_ahead_.approaches.emplace(number_of(approach.voxel, approach.axis), std::move(approach));
}

Arm::Approach Arm::look_at(const Descent& descent, int effort) const {
  const auto& [voxel, axis] = descent;
  const std::size_t number = number_of(voxel, axis);
  if (looked_ahead_.cut == memory_.cut && looked_ahead_.effort == effort)
    if (const auto known = looked_ahead_.approaches.find(number); known != looked_ahead_.approaches.end())
      return known->second;
  const auto before = no_entry_.find(number);
  const bool same = before != no_entry_.end() && before->second.cut == memory_.cut;
  Approach approach{voxel,
                    axis,
                    entry_seeds(voxel, axis, same ? before->second.effort + 1 : 0, effort),
                    same ? before->second.seeds : 0,
                    0,
                    {}};
  find_next_entry(approach);
  return approach;
}

}  // namespace sculpt
