// Keyframe lines exactly as TrajectoryWriter writes them, read without a JSON parser: twenty times faster. Internal to
// trajectory/.
#pragma once

#include <optional>
#include <string_view>

#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// What `parse_line` would give, or nothing where the line is in any way unusual (also where it is wrong): then it is
/// to be parsed as JSON.
std::optional<Keyframe> read_plain_line(std::string_view text, const TrajectoryHeader& header);

}  // namespace sculpt
