// Which bodies touch because a joint holds them together. Internal to verify/. Millimetres.
#pragma once

#include <optional>

#include "core/verify/robot/link_motion.hpp"
#include "core/verify/robot/solid_body.hpp"

namespace sculpt {

/// Whether two bodies are no farther apart than 0.02 mm.
bool touch(const SolidBody& a, const SolidBody& b, const std::vector<Frame>& poses);

/// Whether two bodies with the one joint `joint` between them both come within 1 mm of the same point of its axis
/// (revolute), or of its child's origin (prismatic). Inside of a mesh is where a ray along that axis has left it an odd
/// number of times.
bool meet_at_joint(const SolidBody& a, const SolidBody& b, const MovingJoint& joint, const std::vector<Frame>& poses);

/// Where two bodies that touch do so, about the middle of what they have in common; none if one is a mesh.
std::optional<Vec3> contact_point(const SolidBody& a, const SolidBody& b, const std::vector<Frame>& poses);

/// Whether `point` is no farther than 1 mm from the body's inside; never of a mesh.
bool holds_point(const SolidBody& body, const std::vector<Frame>& poses, const Vec3& point);

}  // namespace sculpt
