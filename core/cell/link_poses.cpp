#include "core/cell/link_poses.hpp"

namespace sculpt {

Frame joint_pose(const Joint& joint, double value) {
  switch (joint.kind) {
    case JointKind::fixed:
      return joint.origin;
    case JointKind::revolute:
      return joint.origin * Eigen::AngleAxisd(value, joint.axis);
    case JointKind::prismatic:
      return joint.origin * Eigen::Translation3d(value * joint.axis);
  }
  return joint.origin;
}

std::vector<Frame> link_poses(const Robot& robot, std::span<const double> values) {
  std::vector<Frame> poses(robot.links.size(), Frame::Identity());
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const Joint& joint = robot.joints[j];
    poses[static_cast<std::size_t>(joint.child_link)] =
        poses[static_cast<std::size_t>(joint.parent_link)] * joint_pose(joint, values[j]);
  }
  return poses;
}

}  // namespace sculpt
