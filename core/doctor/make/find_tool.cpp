#include "core/doctor/make/find_tool.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/random.hpp"
#include "core/cell/link_poses.hpp"

namespace sculpt {
namespace {

constexpr int length_samples = 2000;

const Joint* joint_above(const Robot& robot, int link) {
  const int joint = robot.links[static_cast<std::size_t>(link)].parent_joint;
  return joint < 0 ? nullptr : &robot.joints[static_cast<std::size_t>(joint)];
}

/// A finger comes with another one that shifts beside it, or follows one.
bool is_finger(const Robot& robot, const Joint& joint) {
  if (joint.kind != JointKind::prismatic) return false;
  return joint.mimic >= 0 || std::any_of(robot.joints.begin(), robot.joints.end(), [&](const Joint& other) {
           return &other != &joint && other.kind == JointKind::prismatic && other.parent_link == joint.parent_link;
         });
}

/// Joints that can move between the root and the link; nothing where a finger is among them.
std::optional<int> joints_to(const Robot& robot, int link) {
  int count = 0;
  for (const Joint* joint = joint_above(robot, link); joint != nullptr;
       joint = joint_above(robot, joint->parent_link)) {
    if (is_finger(robot, *joint)) return std::nullopt;
    count += joint->kind != JointKind::fixed && joint->mimic < 0;
  }
  return count;
}

std::vector<double> middle_values(const Robot& robot) {
  std::vector<double> values;
  for (const Joint& joint : robot.joints)
    values.push_back(joint.kind == JointKind::fixed ? 0 : std::clamp(0.0, joint.lower, joint.upper));
  return values;
}

/// Joints that turn stand anywhere, others at 0 or the end of their travel that is nearest to it.
std::vector<double> random_values(const Robot& robot, Random& random) {
  std::vector<double> values = middle_values(robot);
  for (std::size_t at = 0; at < values.size(); ++at)
    if (const Joint& joint = robot.joints[at]; joint.kind == JointKind::revolute)
      values[at] = random.between(joint.lower, joint.upper);
  return values;
}

bool is_below(const Robot& robot, int link, int ancestor) {
  for (const Joint* joint = joint_above(robot, link); joint != nullptr; joint = joint_above(robot, joint->parent_link))
    if (joint->parent_link == ancestor) return true;
  return false;
}

/// The last joint above the link that turns; nullptr where none does.
const Joint* last_turn(const Robot& robot, int link) {
  const Joint* joint = joint_above(robot, link);
  while (joint != nullptr && joint->kind != JointKind::revolute) joint = joint_above(robot, joint->parent_link);
  return joint;
}

/// The middle of the boxes around the shapes of a link, in its frame.
std::optional<Vec3> middle_of(const Link& link) {
  Eigen::AlignedBox3d box;
  for (const Shape& shape : link.shapes) {
    box.extend(shape.pose.translation());
    if (shape.mesh)
      for (const Vec3& vertex : shape.mesh->vertices) box.extend(shape.pose * vertex);
  }
  return box.isEmpty() ? std::nullopt : std::optional<Vec3>(box.center());
}

}  // namespace

int find_flange(const Robot& robot) {
  int best = robot.root, most = 0;
  for (int link = 0; link < static_cast<int>(robot.links.size()); ++link) {
    const Joint* above = joint_above(robot, link);
    const auto count = joints_to(robot, link);
    if (above == nullptr || !count || *count == 0) continue;
    const bool is_frame = above->kind == JointKind::fixed && robot.links[static_cast<std::size_t>(link)].shapes.empty();
    const bool best_is_frame = best != robot.root && robot.links[static_cast<std::size_t>(best)].shapes.empty() &&
                               joint_above(robot, best)->kind == JointKind::fixed;
    const bool named = robot.links[static_cast<std::size_t>(link)].name.find("tool0") != std::string::npos;
    if (*count > most || (*count == most && is_frame && (!best_is_frame || named))) {
      best = link;
      most = *count;
    }
  }
  return best;
}

Vec3 find_way_out(const Robot& robot, int flange) {
  const Joint* joint = last_turn(robot, flange);
  if (joint == nullptr) return Vec3::UnitZ();
  const std::vector<Frame> at = link_poses(robot, middle_values(robot));
  const Frame& here = at[static_cast<std::size_t>(flange)];
  const Frame& turned = at[static_cast<std::size_t>(joint->child_link)];
  const Vec3 axis = (here.linear().transpose() * turned.linear() * joint->axis).normalized();
  double along = axis.dot(here.linear().transpose() * (here.translation() - turned.translation()));
  const bool named = robot.links[static_cast<std::size_t>(flange)].name.find("tool0") != std::string::npos;
  if (std::abs(along) < 1e-3 && named && std::abs(axis.z()) > 0.999) return Vec3::UnitZ();
  if (std::abs(along) < 1e-3)
    if (const auto middle = middle_of(robot.links[static_cast<std::size_t>(joint->child_link)]))
      along = axis.dot(here.linear().transpose() * (here.translation() - turned * *middle));
  if (std::abs(along) < 1e-3) return axis.z() < -0.9 ? Vec3(-axis) : axis;
  return along > 0 ? axis : Vec3(-axis);
}

std::vector<int> find_occupants(const Robot& robot, int flange) {
  std::vector<int> found;
  for (int link = 0; link < static_cast<int>(robot.links.size()); ++link)
    if (is_below(robot, link, flange) && !robot.links[static_cast<std::size_t>(link)].shapes.empty())
      found.push_back(link);
  return found;
}

Vec3 find_mean_place(const Robot& robot, int flange) {
  Random random(1);
  Vec3 sum = Vec3::Zero();
  for (int sample = 0; sample < length_samples; ++sample)
    sum += link_poses(robot, random_values(robot, random))[static_cast<std::size_t>(flange)].translation();
  return sum / length_samples;
}

double find_arm_length(const Robot& robot, int flange) {
  Random random(1);
  int first = flange;
  for (const Joint* joint = joint_above(robot, flange); joint != nullptr;
       joint = joint_above(robot, joint->parent_link))
    if (joint->kind == JointKind::revolute) first = joint->child_link;
  double longest = 0;
  for (int sample = 0; sample < length_samples; ++sample) {
    const std::vector<Frame> at = link_poses(robot, random_values(robot, random));
    longest = std::max(longest, (at[static_cast<std::size_t>(flange)].translation() -
                                 at[static_cast<std::size_t>(first)].translation())
                                    .norm());
  }
  return longest;
}

}  // namespace sculpt
