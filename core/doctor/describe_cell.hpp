// What a cell consists of: its chain, the joints beside it, its bodies.
#pragma once

#include "core/doctor/findings.hpp"

namespace sculpt {

std::vector<JointFinding> describe_chain(const Cell& cell, const Chain& chain);

/// Joints that can move but are neither of the chain nor mimic one that is.
std::vector<IdleJoint> find_idle_joints(const Cell& cell, const Chain& chain);

/// Links with collision shapes, in the order of the robot's.
std::vector<BodyFinding> describe_bodies(const Cell& cell);

/// The first link that goes along with the tool's and that the tool's middle line passes through, beyond the first
/// tenth of what sticks out; empty if there is none. Then the tool's link points into the arm.
std::string find_link_in_tool(const Cell& cell);

/// A box around the shape, along the axes of its link's frame (m).
Eigen::AlignedBox3d box_around(const Shape& shape);

}  // namespace sculpt
