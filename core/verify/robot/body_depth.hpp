// How deep points are inside a body. Internal to verify/. Millimetres, in the frame of the body's shape.
#pragma once

#include "core/verify/robot/solid_body.hpp"

namespace sculpt {

/// Radius of the largest sphere around `point` that is inside the body; negative outside, and always for meshes, which
/// have no inside.
double depth_in(const SolidBody& body, const Vec3& point);

/// Points of the body, spread over all of it and its surface; none for meshes.
std::vector<Vec3> points_of(const SolidBody& body);

}  // namespace sculpt
