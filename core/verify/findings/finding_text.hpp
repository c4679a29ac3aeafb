// Values for the sentences of findings.
#pragma once

#include <string>

#include "core/material/voxel.hpp"

namespace sculpt {

/// Six digits.
std::string text(double value);
/// "(1, 2, 3)".
std::string text(Voxel v);

}  // namespace sculpt
