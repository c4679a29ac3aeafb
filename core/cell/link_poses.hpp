// Forward kinematics of a whole Robot: joint values -> link poses.
#pragma once

#include <span>
#include <vector>

#include "core/cell/robot.hpp"

namespace sculpt {

/// Pose of the joint's child link in its parent link's frame at `value` (rad or m; ignored for fixed joints).
Frame joint_pose(const Joint& joint, double value);

/// Pose of every link in the root link's frame; `values` has one entry per robot joint (mimic joints included).
std::vector<Frame> link_poses(const Robot& robot, std::span<const double> values);

}  // namespace sculpt
