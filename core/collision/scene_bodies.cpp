#include "core/collision/scene_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/collision/margins.hpp"

namespace sculpt {

SceneBodies::SceneBodies(const Cell& cell, const Grid& where, const VoxelSet& standing)
    : chain(cell.chain()),
      grid(where),
      tool(make_tool(cell.tool, where.voxel_m)),
      material(standing),
      bodies(make_bodies(cell, tool)),
      stock(make_stock_body(material, where, cell.stock_link)) {
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
JointBox SceneBodies::find_bounds() const {
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

ToolLine SceneBodies::tool_line(const ToolPose& pose) const {
  return {(pose.ball_m - grid.origin_m) / grid.voxel_m,
          (pose.ball_m + tool.stickout_m * pose.axis - grid.origin_m) / grid.voxel_m};
}

bool SceneBodies::tool_meets_material(const ToolPose& pose, std::optional<Voxel> exempt) const {
  const ToolLine line = tool_line(pose);
  if (material.meets_capsule({line.ball, line.ball}, radii.ball + tool_margin_voxels, exempt)) return true;
  return radii.shank > 0 && material.meets_capsule({line.ball, line.top}, radii.shank + tool_margin_voxels, exempt);
}

bool SceneBodies::near(const Pair& pair, const std::vector<Frame>& at, double reach_m) const {
  const Body& a = bodies[static_cast<std::size_t>(pair.first)];
  const Frame& pose_a = at[static_cast<std::size_t>(a.link)];
  if (pair.second < 0) return near_material(a, pose_a, material, grid, reach_m);
  const Body& b = bodies[static_cast<std::size_t>(pair.second)];
  return near_body(a, pose_a, b, at[static_cast<std::size_t>(b.link)], reach_m);
}

Contact SceneBodies::certify_links(const Configuration& from, const Configuration& step, double middle, double half,
                                   const std::vector<const Pair*>& open) const {
  std::vector<Frame> at;
  count_check();
  chain.link_poses(from + middle * step, at);
  const Configuration joint_steps = half * step.cwiseAbs();
  std::vector<const Pair*> left;
  for (const Pair* pair : open) {
    const double motion = pair->motion(joint_steps);
    if (!near(*pair, at, motion + pair->margin_m)) continue;
    if (motion < pair->margin_m / 2 || near(*pair, at, pair->margin_m)) return pair->contact();
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
double SceneBodies::tool_second_derivative(const Configuration& step) const {
  if (has_mimic)
    return derivative_bounds(chain, turn_rates.dot(step.cwiseAbs()), tool_speed.dot(step.cwiseAbs())).second_m;
  double sum = 0;
  for (int i = 0; i < step.size(); ++i)
    for (int j = 0; j <= i; ++j) sum += (i == j ? 1 : 2) * turn_rates[j] * std::abs(step[i] * step[j]) * tool_speed[i];
  return sum;
}

}  // namespace sculpt
