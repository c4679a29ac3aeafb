#include "core/collision/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/collision/clearance.hpp"
#include "core/collision/link_pairs.hpp"
#include "core/collision/margins.hpp"
#include "core/collision/scene_impl.hpp"

namespace sculpt {
namespace {

Contact kind(int second) {
  return second < 0 ? Contact::link_material : Contact::link_link;
}

}  // namespace

Scene::Impl::Impl(const Cell& cell, const Grid& where, const VoxelSet& standing)
    : chain(cell.chain()),
      grid(where),
      tool(make_tool(cell.tool, where.voxel_m)),
      material(standing),
      bodies(make_bodies(cell, tool)) {
  add_pairs(cell);
  const double h = grid.voxel_m;
  tool_speed = motion_bound(chain, cell.stock_link, cell.tool_link, tool.stickout_m) / h;
  turn_rates = chain.turn_rates();
  radii = {tool.ball_radius_m / h, tool.shank_radius_m / h};
  for (const Joint& joint : cell.robot.joints) has_mimic = has_mimic || joint.mimic >= 0;
  bounds = find_bounds();
  find_never_touching();
}

Scene::Impl::Mover Scene::Impl::make_mover(int body, int from_link) const {
  const Body& mover = bodies[static_cast<std::size_t>(body)];
  return {body, motion_bound(chain, from_link, mover.link, mover.hull.extent()),
          turn_bound(chain, from_link, mover.link), find_drives(chain, from_link, mover.link)};
}

Configuration Scene::Impl::grid_speed_from(int link) const {
  const Vec3 first = grid.origin_m, last = grid.origin_m + Vec3::Constant(grid.n * grid.voxel_m);
  return motion_bound(chain, link, chain.stock_link(), first.cwiseAbs().cwiseMax(last.cwiseAbs()).norm());
}

/// Turns are the same at any angle; what is shifted far out moves fast when it is turned.
JointBox Scene::Impl::find_bounds() const {
  const double anywhere = std::numeric_limits<double>::max();
  JointBox box{Configuration::Constant(chain.dof(), -anywhere), Configuration::Constant(chain.dof(), anywhere)};
  const std::vector<Joint>& joints = chain.robot().joints;
  for (int c = 0; c < chain.dof(); ++c) {
    const int leader = chain.joints()[static_cast<std::size_t>(c)];
    const bool shifts = std::any_of(joints.begin(), joints.end(), [&](const Joint& joint) {
      const bool moves = joint.mimic == leader || &joint == &joints[static_cast<std::size_t>(leader)];
      return moves && joint.kind == JointKind::prismatic;
    });
    if (!shifts) continue;
    box.low[c] = chain.lower()[c];
    box.high[c] = chain.upper()[c];
  }
  return box;
}

void Scene::Impl::add_pairs(const Cell& cell) {
  const std::vector<int> group = rigid_groups(cell.robot);
  const int stock_group = group[static_cast<std::size_t>(cell.stock_link)];
  const int tool_group = group[static_cast<std::size_t>(cell.tool_link)];
  const auto group_of = [&](const Body& body) { return group[static_cast<std::size_t>(body.link)]; };
  const auto link_pairs = find_link_pairs(cell.robot);
  const auto apart = [&](const Body& a, const Body& b) {
    if (a.tool != b.tool) return group_of(a.tool ? b : a) != tool_group;
    return !a.tool && std::binary_search(link_pairs.begin(), link_pairs.end(), std::make_pair(a.link, b.link));
  };
  for (const Body& body : bodies)
    if (!body.tool && group_of(body) == stock_group) fixed.push_back(&body);
  for (int a = 0; a < static_cast<int>(bodies.size()); ++a) {
    const Body& first = bodies[static_cast<std::size_t>(a)];
    if (!first.tool && group_of(first) != stock_group)
      pairs.push_back({a, -1, link_margin_m, {make_mover(a, cell.stock_link)}, grid_speed_from(first.link)});
    for (int b = a + 1; b < static_cast<int>(bodies.size()); ++b) {
      const Body& second = bodies[static_cast<std::size_t>(b)];
      if (!apart(first, second)) continue;
      const double margin = first.tool || second.tool ? tool_margin_voxels * grid.voxel_m : link_margin_m;
      Pair pair{a, b, margin, {make_mover(a, second.link), make_mover(b, first.link)}, {}};
      if (pair.movers[0].drives.empty()) continue;
      pair.tool_and_fixed = (first.tool || second.tool) && group_of(first.tool ? second : first) == stock_group;
      pairs.push_back(std::move(pair));
    }
  }
}

ToolLine Scene::Impl::tool_line(const ToolPose& pose) const {
  return {(pose.ball_m - grid.origin_m) / grid.voxel_m,
          (pose.ball_m + tool.stickout_m * pose.axis - grid.origin_m) / grid.voxel_m};
}

bool Scene::Impl::tool_meets_material(const ToolPose& pose, std::optional<Voxel> exempt) const {
  const ToolLine line = tool_line(pose);
  if (material.meets_capsule({line.ball, line.ball}, radii.ball + tool_margin_voxels, exempt)) return true;
  return radii.shank > 0 && material.meets_capsule({line.ball, line.top}, radii.shank + tool_margin_voxels, exempt);
}

bool Scene::Impl::near(const Pair& pair, const std::vector<Frame>& at, double reach_m) const {
  const Body& a = bodies[static_cast<std::size_t>(pair.first)];
  const Frame& pose_a = at[static_cast<std::size_t>(a.link)];
  if (pair.second < 0) return near_material(a, pose_a, material, grid, reach_m);
  const Body& b = bodies[static_cast<std::size_t>(pair.second)];
  return near_body(a, pose_a, b, at[static_cast<std::size_t>(b.link)], reach_m);
}

/// Marks the pairs that one joint moves and that it can move as it likes. Material only shrinks, so that stays true.
void Scene::Impl::find_never_touching() {
  for (Pair& pair : pairs) {
    if (pair.joints() != 1) continue;
    const Configuration range = chain.upper() - chain.lower();
    pair.never_touch = certify_links(chain.lower(), range, 0.5, 0.5, {&pair}) == Contact::none;
  }
}

Contact Scene::Impl::certify_links(const Configuration& from, const Configuration& step, double middle, double half,
                                   const std::vector<const Pair*>& open) const {
  std::vector<Frame> at;
  count_check();
  chain.link_poses(from + middle * step, at);
  const Configuration joint_steps = half * step.cwiseAbs();
  std::vector<const Pair*> left;
  for (const Pair* pair : open) {
    const double motion = pair->motion(joint_steps);
    if (!near(*pair, at, motion + pair->margin_m)) continue;
    if (motion < pair->margin_m / 2 || near(*pair, at, pair->margin_m)) return kind(pair->second);
    left.push_back(pair);
  }
  if (left.empty()) return Contact::none;
  const Contact before = certify_links(from, step, middle - half / 2, half / 2, left);
  if (before != Contact::none) return before;
  return certify_links(from, step, middle + half / 2, half / 2, left);
}

/// Bound on the second derivative of any tool point along from + t step. The mixed derivative by two joints is a
/// rotation applied to what the one nearer the tool moves, so that one's speed bounds it; a mimic joint may stand
/// anywhere, so then all turns are applied to all motions.
double Scene::Impl::tool_bend(const Configuration& step) const {
  if (has_mimic)
    return derivative_bounds(chain, turn_rates.dot(step.cwiseAbs()), tool_speed.dot(step.cwiseAbs())).second_m;
  double sum = 0;
  for (int i = 0; i < step.size(); ++i)
    for (int j = 0; j <= i; ++j) sum += (i == j ? 1 : 2) * turn_rates[j] * std::abs(step[i] * step[j]) * tool_speed[i];
  return sum;
}

Scene::Scene(const Cell& cell, const Grid& grid, const VoxelSet& standing)
    : impl_(std::make_unique<Impl>(cell, grid, standing)) {}
Scene::~Scene() = default;

const Chain& Scene::chain() const {
  return impl_->chain;
}
const Grid& Scene::grid() const {
  return impl_->grid;
}
const Tool& Scene::tool() const {
  return impl_->tool;
}
const Material& Scene::material() const {
  return impl_->material;
}
void Scene::remove(Voxel v) {
  impl_->material.remove(v);
}

void Scene::leave(const VoxelSet& left) {
  impl_->material = Material(left);
}

bool Scene::tool_fits(const ToolPose& pose, std::optional<Voxel> exempt) const {
  const ToolLine line = impl_->tool_line(pose);
  const double radius = std::max(impl_->radii.ball, impl_->radii.shank) + tool_margin_voxels;
  return !impl_->material.meets_capsule({line.ball, line.top}, radius, exempt);
}

std::uint64_t Scene::checks() const {
  return impl_->checks;
}

std::string Scene::describe_contact(const Configuration& q) const {
  if (!impl_->chain.within_limits(q)) return "a joint is outside its limits";
  if (impl_->tool_meets_material(impl_->chain.tool_pose(q), {})) return "the tool touches the stock";
  const auto name = [&](const Body& body) {
    return body.tool ? "the tool" : "'" + impl_->chain.robot().links[static_cast<std::size_t>(body.link)].name + "'";
  };
  std::vector<Frame> at;
  impl_->chain.link_poses(q, at);
  for (const Impl::Pair& pair : impl_->pairs)
    if (impl_->near(pair, at, pair.margin_m))
      return name(impl_->bodies[static_cast<std::size_t>(pair.first)]) + " touches " +
             (pair.second < 0 ? "the stock" : name(impl_->bodies[static_cast<std::size_t>(pair.second)]));
  return {};
}

Contact Scene::contact_at(const Configuration& q, std::optional<Voxel> exempt) const {
  if (!impl_->chain.within_limits(q)) return Contact::limits;
  impl_->count_check();
  if (impl_->tool_meets_material(impl_->chain.tool_pose(q), exempt)) return Contact::tool_material;
  std::vector<Frame> at;
  impl_->chain.link_poses(q, at);
  for (const Impl::Pair& pair : impl_->pairs)
    if (impl_->near(pair, at, pair.margin_m)) return kind(pair.second);
  return Contact::none;
}

bool Scene::room_is_clear(const Vec3& low_m, const Vec3& high_m) const {
  std::vector<Frame> at;
  impl_->chain.link_poses(Configuration::Zero(impl_->chain.dof()), at);
  Shape box;
  box.sides_m = high_m - low_m;
  box.pose.translation() = (low_m + high_m) / 2;
  const Vec3& middle = box.pose.translation();
  const Capsule hull{{middle, middle}, box.sides_m.norm() / 2};
  const Body region{impl_->chain.stock_link(), false, {{box, hull}}, hull};
  return std::none_of(impl_->fixed.begin(), impl_->fixed.end(), [&](const Body* body) {
    return near_body(region, Frame::Identity(), *body, at[static_cast<std::size_t>(body->link)], 0);
  });
}

Contact Scene::certify(const Configuration& from, const Configuration& to, std::optional<Voxel> exempt) const {
  if (!impl_->chain.within_limits(from) || !impl_->chain.within_limits(to)) return Contact::limits;
  const Configuration step = to - from;
  const auto line_at = [&](double t) {
    impl_->count_check();
    return impl_->tool_line(impl_->chain.tool_pose(from + t * step));
  };
  if (!tool_sweep_is_free(impl_->material, line_at, impl_->tool_bend(step), impl_->radii, tool_margin_voxels, exempt))
    return Contact::tool_material;
  std::vector<const Impl::Pair*> open;
  for (const Impl::Pair& pair : impl_->pairs)
    if (!pair.never_touch) open.push_back(&pair);
  return impl_->certify_links(from, step, 0.5, 0.5, open);
}

}  // namespace sculpt
