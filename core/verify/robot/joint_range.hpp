// A box of joint values, and what is true in all of it. Internal to verify/. Coordinates in rad or m, lengths in mm.
#pragma once

#include "core/verify/robot/link_motion.hpp"
#include "core/verify/robot/solid_body.hpp"

namespace sculpt {

/// Every coordinate c is within middle[c] -+ half[c].
struct JointRange {
  Configuration middle, half;
};

/// Between the limits of the robot joints that are the coordinates.
JointRange joint_limits(const Robot& robot, const std::vector<int>& joints);

/// True if it is proved that the two bodies have a point in common wherever the coordinates are in the range: the range
/// is cut until in each part a point of the one is deeper inside the other than the part can move it. False says
/// nothing. Never true of meshes.
bool overlap_everywhere(const SolidBody& a, const SolidBody& b, const LinkMotion& motion, const JointRange& range);

}  // namespace sculpt
