// What the lines of a plan with milling tools have that others have not (format 2). Internal to trajectory/.
#pragma once

#include <string>

#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

class LineFields;

/// The fields of the header, each with a comma before it.
void append_mill_header(std::string& text, const MillHeader& header);
/// Throws InputError `trajectory_invalid`.
MillHeader parse_mill_header(const LineFields& fields);

/// As write_keyframe_line. The keyframe has a MillStep of this header.
char* write_mill_line(char* out, const Keyframe& keyframe, const MillHeader& header);
/// That such a line is longer than one of a thin tool.
std::size_t max_mill_line_bytes(const MillHeader& header);
/// `type`: of the line. Throws InputError `trajectory_invalid`.
Keyframe parse_mill_line(const LineFields& fields, const std::string& type, const TrajectoryHeader& header);

}  // namespace sculpt
