// What is near what in a scene: for those who explain a cell.
#include <algorithm>

#include "core/collision/scene.hpp"
#include "core/collision/scene_bodies.hpp"

namespace sculpt {
namespace {

/// Of a gap that is looked for between two distances (m).
constexpr double finest_m = 1e-4;

int number_of(const Body& body) {
  return body.tool ? NearBodies::tool : body.link;
}

NearBodies name_pair(const SceneBodies& all, const SceneBodies::Pair& pair) {
  const int first = number_of(all.bodies[static_cast<std::size_t>(pair.first)]);
  if (pair.second < 0) return {first, NearBodies::stock, 0, true};
  return {first, number_of(all.bodies[static_cast<std::size_t>(pair.second)]), 0, true};
}

/// The largest distance, as far as `within_m`, that the two surely are apart.
double find_gap(const SceneBodies& all, const SceneBodies::Pair& pair, const std::vector<Frame>& at, double within_m) {
  if (!all.near(pair, at, within_m)) return within_m;
  if (all.near(pair, at, 0)) return 0;
  double apart = 0, near = within_m;
  while (near - apart > finest_m) {
    const double middle = (apart + near) / 2;
    (all.near(pair, at, middle) ? near : apart) = middle;
  }
  return apart;
}

}  // namespace

std::vector<NearBodies> Scene::near_bodies(const Configuration& q, double within_m) const {
  std::vector<NearBodies> found;
  if (bodies_->tool_meets_material(bodies_->chain.tool_pose(q), {}))
    found.push_back({NearBodies::tool, NearBodies::stock, 0, true});
  std::vector<Frame> at;
  bodies_->chain.link_poses(q, at);
  for (const SceneBodies::Pair& pair : bodies_->pairs) {
    if (!bodies_->near(pair, at, std::max(within_m, pair.margin_m))) continue;
    NearBodies near = name_pair(*bodies_, pair);
    near.gap_m = find_gap(*bodies_, pair, at, std::max(within_m, pair.margin_m));
    near.too_near = near.gap_m < pair.margin_m;
    found.push_back(near);
  }
  return found;
}

std::optional<NearBodies> Scene::blocking_links(const Configuration& q) const {
  bodies_->count_check();
  std::vector<Frame> at;
  bodies_->chain.link_poses(q, at);
  for (const SceneBodies::Pair& pair : bodies_->pairs)
    if (!pair.is_free_between(q, q) && bodies_->near(pair, at, pair.margin_m)) return name_pair(*bodies_, pair);
  return std::nullopt;
}

}  // namespace sculpt
