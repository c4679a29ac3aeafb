// Where a maker's URDF wants the tool: at the end of the arm, and which way is out.
#pragma once

#include <string>
#include <vector>

#include "core/cell/robot.hpp"

namespace sculpt {

/// The link that a spindle would be screwed to: of what the longest row of joints moves, without the fingers of a
/// gripper, a frame without shapes that is fixed to the last link if there is one (tool0, flange), else that link.
int find_flange(const Robot& robot);

/// Unit vector in the link's frame along the last turning joint above it, away from the arm; +z where that says
/// nothing.
Vec3 find_way_out(const Robot& robot, int flange);

/// Links with shapes below the flange: a gripper, say, where the spindle would be.
std::vector<int> find_occupants(const Robot& robot, int flange);

/// Where the link's origin is on the average of configurations at random (m, frame of the root).
Vec3 find_mean_place(const Robot& robot, int flange);

/// How far from the middle of the robot's first moving joint the link's origin comes, by samples (m).
double find_arm_length(const Robot& robot, int flange);

}  // namespace sculpt
