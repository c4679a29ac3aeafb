#include "core/collision/scene_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/collision/margins.hpp"

namespace sculpt {
namespace {

constexpr int max_halvings = 12;  // of a box that is settled

}  // namespace

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

void SceneBodies::settle(const JointBox& box) {
  settled.assign(1, {bounded(box), {}});
  for (const Pair& pair : pairs)
    if (!pair.never_touch) settled[0].open.push_back(&pair);
  settle(0, max_halvings);
}

void SceneBodies::settle(std::size_t at, int halvings) {
  const JointBox box = settled[at].box;
  std::erase_if(settled[at].open, [&](const Pair* pair) {
    int checks_left = 1;
    return is_free_in(*pair, box, checks_left);
  });
  if (settled[at].open.empty() || halvings == 0) return;
  SettledBox low{box, settled[at].open}, high = low;
  const Eigen::Index coordinate = halvings % box.low.size();
  const double split = box.centre()[coordinate];
  low.box.high[coordinate] = high.box.low[coordinate] = split;
  const std::size_t parts = settled.size();
  settled[at].parts = parts;
  settled[at].coordinate = coordinate;
  settled[at].split = split;
  settled.push_back(std::move(low));
  settled.push_back(std::move(high));
  settle(parts, halvings - 1);
  settle(parts + 1, halvings - 1);
}

std::vector<const SceneBodies::Pair*> SceneBodies::open_between(const Configuration& from,
                                                                const Configuration& to) const {
  std::vector<const Pair*> open;
  const auto look_at = [&](const Pair& pair) {
    if (!pair.never_touch && !pair.is_free_between(from, to)) open.push_back(&pair);
  };
  if (settled.empty() || !settled[0].box.holds(from) || !settled[0].box.holds(to)) {
    for (const Pair& pair : pairs) look_at(pair);
    return open;
  }
  std::size_t at = 0;
  while (settled[at].parts > 0) {
    const SettledBox& box = settled[at];
    const double low = std::min(from[box.coordinate], to[box.coordinate]),
                 high = std::max(from[box.coordinate], to[box.coordinate]);
    if (low < box.split && high > box.split) break;
    at = box.parts + (high <= box.split ? 0 : 1);
  }
  for (const Pair* pair : settled[at].open) look_at(*pair);
  return open;
}

bool SceneBodies::near_sliding(const Pair& pair, const std::vector<Frame>& at, const Configuration& end) const {
  const Body &a = bodies[static_cast<std::size_t>(pair.first)], &b = bodies[static_cast<std::size_t>(pair.second)];
  const auto first = static_cast<std::size_t>(a.link), second = static_cast<std::size_t>(b.link);
  std::vector<Frame> there;
  chain.link_poses(end, there);
  const Vec3 slide =
      (there[second].inverse() * there[first]).translation() - (at[second].inverse() * at[first]).translation();
  return near_sliding_body(a, at[first], slide, b, at[second], pair.margin_m);
}

ToolEdge SceneBodies::tool_edge(const Configuration& from, const Configuration& to) const {
  const auto line_at = [&](double t) {
    count_check();
    return tool_line(chain.tool_pose(from + t * (to - from)));
  };
  return {line_at(0), line_at(1), line_at, tool_second_derivative(to - from)};
}

Contact SceneBodies::certify(const Configuration& from, const Configuration& to, const ToolEdge& edge,
                             const Exempt& exempt) const {
  if (!tool_sweep_is_free(material, edge, radii, tool_margin_voxels, exempt)) return Contact::tool_material;
  const std::vector<const Pair*> open = open_between(from, to);
  return open.empty() ? Contact::none : certify_links(from, to - from, 0.5, 0.5, open);
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
    if (!has_mimic && pair->slides(joint_steps) && !near_sliding(*pair, at, from + (middle + half) * step)) continue;
    if (motion < pair->margin_m / 2 || near(*pair, at, pair->margin_m)) return pair->contact();
    left.push_back(pair);
  }
  if (left.empty()) return Contact::none;
  const Contact before = certify_links(from, step, middle - half / 2, half / 2, left);
  if (before != Contact::none) return before;
  return certify_links(from, step, middle + half / 2, half / 2, left);
}

/// A tool point is within an eighth of that of the straight line between where it is at both ends. How far the tool
/// reaches is convex along the edge then, and the plane moves evenly: who is short of it at both ends of the first part
/// and at the end of the last is always.
bool SceneBodies::stays_behind_rest(const ToolEdge& edge, const VoxelLine& run) const {
  const auto point = [](Voxel v) { return Vec3(v.i, v.j, v.k); };
  const int count = l1(run.first, run.last) + 1;
  const Vec3 way = point(sign(run.last - run.first));
  const double stray = edge.second_derivative / 8 + tool_margin_voxels;
  const auto is_short = [&](int gone_through, int part) {
    const double t = static_cast<double>(gone_through) / count;
    const double ball = way.dot(edge.start.ball + t * (edge.end.ball - edge.start.ball)),
                 top = way.dot(edge.start.top + t * (edge.end.top - edge.start.top));
    const double reach =
        radii.shank > 0 ? std::max(ball + radii.ball, std::max(ball, top) + radii.shank) : ball + radii.ball;
    return reach + stray <= way.dot(point(run.first) + Vec3::Constant(0.5)) + part - 0.5;
  };
  return is_short(0, 1) && is_short(1, 1) && is_short(count, count);
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
