#include "core/collision/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/collision/clearance.hpp"
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
  find_free_ranges();
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

const std::vector<UncheckedLinks>& Scene::unchecked_links() const {
  return impl_->unchecked;
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
             (pair.second < 0 ? "the stock" : name(impl_->bodies[static_cast<std::size_t>(pair.second)])) +
             (pair.of_links ? " (if these two may touch, list them in \"ignore_pairs\" of the cell file)" : "");
  return {};
}

Contact Scene::contact_at(const Configuration& q, std::optional<Voxel> exempt) const {
  if (!impl_->chain.within_limits(q)) return Contact::limits;
  impl_->count_check();
  if (impl_->tool_meets_material(impl_->chain.tool_pose(q), exempt)) return Contact::tool_material;
  std::vector<Frame> at;
  impl_->chain.link_poses(q, at);
  for (const Impl::Pair& pair : impl_->pairs)
    if (!pair.is_free_between(q, q) && impl_->near(pair, at, pair.margin_m)) return kind(pair.second);
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
    if (!pair.never_touch && !pair.is_free_between(from, to)) open.push_back(&pair);
  return impl_->certify_links(from, step, 0.5, 0.5, open);
}

}  // namespace sculpt
