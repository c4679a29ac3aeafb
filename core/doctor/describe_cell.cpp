#include "core/doctor/describe_cell.hpp"

#include <algorithm>

#include "core/cell/link_poses.hpp"
#include "core/cell/link_tree.hpp"
#include "core/collision/link_pairs.hpp"
#include "core/collision/shape/motion_bound.hpp"
#include "core/picture/facets.hpp"

namespace sculpt {
namespace {

/// The joint that a mimic joint follows in the end; itself where it is none.
int leader_of(const Robot& robot, int joint) {
  while (robot.joints[static_cast<std::size_t>(joint)].mimic >= 0)
    joint = robot.joints[static_cast<std::size_t>(joint)].mimic;
  return joint;
}

/// Its name; empty where the link is fixed to the root.
std::string moving_joint_above(const Robot& robot, int link) {
  for (int joint = robot.links[static_cast<std::size_t>(link)].parent_joint; joint >= 0;) {
    const Joint& at = robot.joints[static_cast<std::size_t>(joint)];
    if (at.kind != JointKind::fixed) return at.name;
    joint = robot.links[static_cast<std::size_t>(at.parent_link)].parent_joint;
  }
  return {};
}

/// Does it cut the z axis between the two heights?
bool cuts_z_axis(const Facet& facet, double low, double high) {
  const auto& [a, b, c] = facet.corners;
  const auto cross = [](const Vec3& u, const Vec3& v) { return u.x() * v.y() - u.y() * v.x(); };
  const double of_c = cross(a, b), of_a = cross(b, c), of_b = cross(c, a), all = of_a + of_b + of_c;
  if (all == 0 || of_a * all < 0 || of_b * all < 0 || of_c * all < 0) return false;
  const double height = (of_a * a.z() + of_b * b.z() + of_c * c.z()) / all;
  return height > low && height < high;
}

bool is_of(const Chain& chain, int joint) {
  return std::find(chain.joints().begin(), chain.joints().end(), joint) != chain.joints().end();
}

}  // namespace

std::vector<JointFinding> describe_chain(const Cell& cell, const Chain& chain) {
  const Configuration home = cell.home(chain);
  std::vector<JointFinding> joints;
  for (int c = 0; c < chain.dof(); ++c) {
    const int index = chain.joints()[static_cast<std::size_t>(c)];
    const Joint& joint = cell.robot.joints[static_cast<std::size_t>(index)];
    JointFinding found{joint.name, joint.kind, chain.lower()[c], chain.upper()[c], home[c], false, {}};
    found.carries_stock = carries(cell.robot, index, cell.stock_link) && !carries(cell.robot, index, cell.tool_link);
    for (int other = 0; other < static_cast<int>(cell.robot.joints.size()); ++other)
      if (other != index && leader_of(cell.robot, other) == index)
        found.followers.push_back(cell.robot.joints[static_cast<std::size_t>(other)].name);
    joints.push_back(std::move(found));
  }
  return joints;
}

std::vector<IdleJoint> find_idle_joints(const Cell& cell, const Chain& chain) {
  std::vector<IdleJoint> idle;
  for (int index = 0; index < static_cast<int>(cell.robot.joints.size()); ++index) {
    const Joint& joint = cell.robot.joints[static_cast<std::size_t>(index)];
    if (joint.kind == JointKind::fixed || is_of(chain, leader_of(cell.robot, index))) continue;
    idle.push_back({joint.name, cell.robot.links[static_cast<std::size_t>(joint.child_link)].name, joint.kind,
                    cell.rest[static_cast<std::size_t>(index)],
                    !find_drives(chain, cell.robot.root, joint.parent_link).empty()});
  }
  return idle;
}

Eigen::AlignedBox3d box_around(const Shape& shape) {
  Eigen::AlignedBox3d box;
  if (shape.kind == ShapeKind::mesh) {
    for (const Vec3& vertex : shape.mesh->vertices) box.extend(shape.pose * vertex);
    return box;
  }
  Vec3 half = shape.sides_m / 2;
  if (shape.kind == ShapeKind::sphere) half = Vec3::Constant(shape.radius_m);
  if (shape.kind == ShapeKind::cylinder) half = {shape.radius_m, shape.radius_m, shape.length_m / 2};
  if (shape.kind == ShapeKind::sphere) {
    box.extend(shape.pose.translation() - half);
    box.extend(shape.pose.translation() + half);
    return box;
  }
  for (int corner = 0; corner < 8; ++corner)
    box.extend(shape.pose * Vec3(corner & 1 ? half.x() : -half.x(), corner & 2 ? half.y() : -half.y(),
                                 corner & 4 ? half.z() : -half.z()));
  return box;
}

std::vector<BodyFinding> describe_bodies(const Cell& cell) {
  std::vector<BodyFinding> bodies;
  for (int link = 0; link < static_cast<int>(cell.robot.links.size()); ++link) {
    const Link& source = cell.robot.links[static_cast<std::size_t>(link)];
    if (source.shapes.empty()) continue;
    BodyFinding body{source.name, source.shapes.size()};
    Eigen::AlignedBox3d box;
    for (const Shape& shape : source.shapes) {
      box.extend(box_around(shape));
      if (shape.mesh) body.facets += shape.mesh->triangles.size();
    }
    body.size_m = box.sizes();
    body.moved_by = moving_joint_above(cell.robot, link);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

std::string find_link_in_tool(const Cell& cell) {
  if (cell.tool.stickout_m == 0) return {};
  const std::vector<int> group = rigid_groups(cell.robot);
  const std::vector<Frame> at = link_poses(cell.robot, cell.rest);
  const Frame& nose = at[static_cast<std::size_t>(cell.tool_link)];
  for (std::size_t link = 0; link < group.size(); ++link) {
    if (group[link] != group[static_cast<std::size_t>(cell.tool_link)]) continue;
    std::vector<Facet> facets;
    const bool holds_tool = static_cast<int>(link) == cell.tool_link && !cell.tool.holder.empty();
    for (const Shape& shape : cell.robot.links[link].shapes)
      if (!holds_tool) add_facets(shape, nose.inverse() * at[link], {}, facets);
    for (const Facet& facet : facets)
      if (cuts_z_axis(facet, 0.1 * cell.tool.stickout_m, cell.tool.stickout_m)) return cell.robot.links[link].name;
  }
  return {};
}

}  // namespace sculpt
