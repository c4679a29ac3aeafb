#include "core/collision/scene.hpp"

#include <algorithm>

#include "core/collision/clearance.hpp"
#include "core/collision/margins.hpp"
#include "core/collision/scene_bodies.hpp"

namespace sculpt {
Scene::Scene(const Cell& cell, const Grid& grid, const VoxelSet& standing)
    : bodies_(std::make_unique<SceneBodies>(cell, grid, standing)) {}
Scene::~Scene() = default;

const Chain& Scene::chain() const {
  return bodies_->chain;
}
const Grid& Scene::grid() const {
  return bodies_->grid;
}
const Tool& Scene::tool() const {
  return bodies_->tool;
}
const Material& Scene::material() const {
  return bodies_->material;
}
void Scene::remove(Voxel v) {
  bodies_->material.remove(v);
}

void Scene::leave(const VoxelSet& left) {
  bodies_->material = Material(left);
}

void Scene::settle(const JointBox& box) {
  bodies_->settle(box);
}

const Body& Scene::full_stock() const {
  return bodies_->stock;
}

Body Scene::stock_of(const VoxelSet& blocks) const {
  const Grid& fine = bodies_->grid;
  const Grid coarse{blocks.n(), fine.voxel_m * fine.n / blocks.n(), fine.origin_m};
  return make_stock_body(Material(blocks), coarse, bodies_->chain.stock_link());
}

bool Scene::tool_fits(const ToolPose& pose, std::optional<Voxel> exempt) const {
  const ToolLine line = bodies_->tool_line(pose);
  const double radius = std::max(bodies_->radii.ball, bodies_->radii.shank) + tool_margin_voxels;
  return !bodies_->material.meets_capsule({line.ball, line.top}, radius, exempt);
}

const std::vector<UncheckedLinks>& Scene::unchecked_links() const {
  return bodies_->unchecked;
}

std::uint64_t Scene::checks() const {
  return bodies_->checks;
}

std::string Scene::describe_contact(const Configuration& q) const {
  if (!bodies_->chain.within_limits(q)) return "a joint is outside its limits";
  if (bodies_->tool_meets_material(bodies_->chain.tool_pose(q), {})) return "the tool touches the stock";
  const auto name = [&](const Body& body) {
    return body.tool ? "the tool" : "'" + bodies_->chain.robot().links[static_cast<std::size_t>(body.link)].name + "'";
  };
  std::vector<Frame> at;
  bodies_->chain.link_poses(q, at);
  for (const SceneBodies::Pair& pair : bodies_->pairs)
    if (bodies_->near(pair, at, pair.margin_m))
      return name(bodies_->bodies[static_cast<std::size_t>(pair.first)]) + " touches " +
             (pair.second < 0 ? "the stock" : name(bodies_->bodies[static_cast<std::size_t>(pair.second)])) +
             (pair.of_links ? " (if these two may touch, list them in \"ignore_pairs\" of the cell file)" : "");
  return {};
}

Contact Scene::contact_at(const Configuration& q, std::optional<Voxel> exempt) const {
  if (!bodies_->chain.within_limits(q)) return Contact::limits;
  bodies_->count_check();
  if (bodies_->tool_meets_material(bodies_->chain.tool_pose(q), exempt)) return Contact::tool_material;
  std::vector<Frame> at;
  bodies_->chain.link_poses(q, at);
  const std::vector<SceneBodies::Pair>& pairs = bodies_->pairs;
  const auto touches = [&](const SceneBodies::Pair& pair) {
    return !pair.is_free_between(q, q) && bodies_->near(pair, at, pair.margin_m);
  };
  // What was in the way last mostly is again.
  const std::size_t last = bodies_->last_contact.load(std::memory_order_relaxed);
  if (last < pairs.size() && touches(pairs[last])) return pairs[last].contact();
  const auto found = std::ranges::find_if(pairs, touches);
  if (found == pairs.end()) return Contact::none;
  bodies_->last_contact.store(static_cast<std::size_t>(found - pairs.begin()), std::memory_order_relaxed);
  return found->contact();
}

bool Scene::room_is_clear(const Vec3& low_m, const Vec3& high_m) const {
  std::vector<Frame> at;
  bodies_->chain.link_poses(Configuration::Zero(bodies_->chain.dof()), at);
  Shape box;
  box.sides_m = high_m - low_m;
  box.pose.translation() = (low_m + high_m) / 2;
  const Body region(bodies_->chain.stock_link(), false, {{std::make_shared<const ShapeTree>(make_tree(box)), 0}});
  return std::none_of(bodies_->fixed.begin(), bodies_->fixed.end(), [&](const Body* body) {
    return near_body(region, Frame::Identity(), *body, at[static_cast<std::size_t>(body->link)], 0);
  });
}

Contact Scene::certify(const Configuration& from, const Configuration& to, std::optional<Voxel> exempt) const {
  if (!bodies_->chain.within_limits(from) || !bodies_->chain.within_limits(to)) return Contact::limits;
  return bodies_->certify(from, to, bodies_->tool_edge(from, to), exempt);
}

bool Scene::certify_run(const Configuration& from, const Configuration& to, const VoxelLine& run) const {
  if (!bodies_->chain.within_limits(from) || !bodies_->chain.within_limits(to)) return false;
  const ToolEdge tool = bodies_->tool_edge(from, to);
  return bodies_->stays_behind_rest(tool, run) && bodies_->certify(from, to, tool, run) == Contact::none;
}

}  // namespace sculpt
