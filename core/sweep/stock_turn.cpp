#include "core/sweep/stock_turn.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/collision/shape/motion_bound.hpp"

namespace sculpt {
namespace {

constexpr double same = 1e-9;  // m, or of unit vectors

bool is_upright(const Vec3& axis) {
  return axis.head<2>().norm() < same;
}

/// Is it the same after a quarter turn about the upright line through `middle`?
bool is_alike_all_around(const Shape& shape, const Frame& link, const Vec3& middle) {
  const Frame pose = link * shape.pose;
  if ((pose.translation() - middle).head<2>().norm() > same) return false;
  if (shape.kind == ShapeKind::sphere) return true;
  if (shape.kind == ShapeKind::mesh || !is_upright(pose.linear().col(2))) return false;
  return shape.kind == ShapeKind::cylinder || std::abs(shape.sides_m.x() - shape.sides_m.y()) < same;
}

/// The links that stay with `link` where the robot is cut at `joint`.
std::vector<bool> links_on_side(const Robot& robot, int link, int joint) {
  std::vector<bool> side(robot.links.size());
  side[static_cast<std::size_t>(link)] = true;
  for (bool more = true; more;) {
    more = false;
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      if (static_cast<int>(j) == joint) continue;
      const auto parent = static_cast<std::size_t>(robot.joints[j].parent_link),
                 child = static_cast<std::size_t>(robot.joints[j].child_link);
      if (side[parent] == side[child]) continue;
      side[parent] = side[child] = more = true;
    }
  }
  return side;
}

}  // namespace

std::optional<StockTurn> find_stock_turn(const Chain& chain, const Grid& grid) {
  const Robot& robot = chain.robot();
  for (const Joint& joint : robot.joints)
    if (joint.mimic >= 0) return std::nullopt;
  const Drive first = find_drives(chain, chain.stock_link(), chain.tool_link()).front();
  const Joint& joint = robot.joints[static_cast<std::size_t>(first.joint)];
  std::vector<Frame> poses;
  chain.link_poses(Configuration::Zero(chain.dof()), poses);
  const Frame& turned = poses[static_cast<std::size_t>(joint.child_link)];
  const Vec3 axis = turned.linear() * joint.axis;
  const Vec3 middle = grid.origin_m + Vec3::Constant(grid.n * grid.voxel_m / 2);
  if (joint.kind != JointKind::revolute || !is_upright(axis) || (turned.translation() - middle).head<2>().norm() > same)
    return std::nullopt;
  const std::vector<bool> side = links_on_side(robot, chain.stock_link(), first.joint);
  for (std::size_t link = 0; link < robot.links.size(); ++link)
    for (const Shape& shape : robot.links[link].shapes)
      if (side[link] && !is_alike_all_around(shape, poses[link], middle)) return std::nullopt;
  return StockTurn{first.coordinate, first.rate * axis.z() > 0 ? 1.0 : -1.0};
}

std::unique_ptr<PostureField> turned(const PostureField& field, const StockTurn& turn, const ToolView& view,
                                     int quarters) {
  for (const double rounds : {0, -1, 1}) {
    const double by = turn.direction * (quarters / 4.0 + rounds) * 2 * std::numbers::pi;
    if (field.can_turn(turn.coordinate, by))
      return std::make_unique<PostureField>(field, view,
                                            by * Configuration::Unit(field.chain().dof(), turn.coordinate));
  }
  return nullptr;
}

}  // namespace sculpt
