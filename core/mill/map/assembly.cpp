#include "core/mill/map/assembly.hpp"

#include <algorithm>

#include "core/collision/link_pairs.hpp"
#include "core/collision/shape/shape_tree.hpp"

namespace sculpt {
namespace {

/// Pose of the links that are fixed to the tool link, in its frame; others are left out.
std::vector<std::pair<int, Frame>> fixed_to_tool(const Cell& cell) {
  const std::vector<int> group = rigid_groups(cell.robot);
  const Chain chain = cell.chain();
  std::vector<Frame> poses;
  chain.link_poses(cell.home(chain), poses);
  const auto tool = static_cast<std::size_t>(cell.tool_link);
  std::vector<std::pair<int, Frame>> found;
  for (std::size_t link = 0; link < group.size(); ++link)
    if (group[link] == group[tool]) found.emplace_back(static_cast<int>(link), poses[tool].inverse() * poses[link]);
  return found;
}

std::vector<Ring> growing(std::vector<Ring> rings) {
  std::ranges::sort(rings, {}, &Ring::height_m);
  std::vector<Ring> outer;
  for (const Ring& ring : rings)
    if (outer.empty() || ring.radius_m > outer.back().radius_m) outer.push_back(ring);
  return outer;
}

}  // namespace

Assembly make_assembly(const Cell& cell, const MillTool& tool) {
  Assembly assembly{tool, {}, 0};
  std::vector<Ring> rings;
  double highest_m = tool.stickout_m;
  const std::vector<Shape> own = tool_shapes(tool);
  for (std::size_t at = 1; at < own.size(); ++at)  // without the cutter
    rings.push_back({own[at].radius_m, tool.stickout_m - own[at].pose.translation().z() - own[at].length_m / 2});
  for (const auto& [link, pose] : fixed_to_tool(cell))
    for (const Shape& shape : cell.robot.links[static_cast<std::size_t>(link)].shapes)
      for (const ShapeTree::Node& node : make_tree(shape).nodes) {
        if (!node.is_leaf()) continue;
        const Convex::Corners corners = node.shape.placed(pose).corners();
        Ring ring{0, tool.stickout_m};
        for (std::size_t at = 0; at < corners.count; ++at) {
          const Vec3& corner = corners.points[at];
          ring.radius_m = std::max(ring.radius_m, corner.head<2>().norm() + corners.radius);
          ring.height_m = std::min(ring.height_m, tool.stickout_m - corner.z() - corners.radius);
          highest_m = std::max(highest_m, tool.stickout_m - corner.z() + corners.radius);
        }
        rings.push_back(ring);
      }
  assembly.rings = growing(std::move(rings));
  assembly.reach_m = highest_m + assembly.radius_m();
  return assembly;
}

Cell guided_by_maps(const Cell& cell, const MillTool& tool) {
  Cell with = cell;
  with.tool = tip_of(tool);
  with.tool.body = tool_shapes(tool);
  return with;
}

}  // namespace sculpt
