// What the cell's loader read from a URDF against what the text says. Internal to verify/.
#pragma once

#include <string>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/verify/robot/urdf_text.hpp"

namespace sculpt {

/// A sentence for each joint or shape of the cell that is not what the text says, and for each that only one of the two
/// has. What the cell file adds is no difference: the post, and cylinders that hold the holder as it describes it.
std::vector<std::string> urdf_differences(const UrdfText& text, const Cell& cell);

/// The same for the text that the cell keeps; one sentence if that cannot be read. None for a cell without text.
std::vector<std::string> urdf_differences(const Cell& cell);

}  // namespace sculpt
