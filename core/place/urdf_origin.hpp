// The origin of one joint in the text of a URDF: everything else stays as it was written.
#pragma once

#include <string>

#include "core/base/frame.hpp"

namespace sculpt {

/// The text with this joint's origin at `at_m` and turned by `turn_rad` more about the parent link's z. Throws
/// InputError `urdf_invalid` where the text has no such joint, as elements of its own.
std::string move_origin(const std::string& urdf, const std::string& joint, const Vec3& at_m, double turn_rad);

}  // namespace sculpt
