// The text of single trajectory lines. Internal to trajectory/: files are read and written through trajectory.hpp and
// export.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/trajectory/header.hpp"
#include "core/trajectory/keyframe.hpp"
#include "core/trajectory/trajectory_end.hpp"

namespace sculpt {

/// Without the newline. Numbers as `write_number` writes them.
std::string header_line(const TrajectoryHeader& header);
std::string end_line(const TrajectoryEnd& end);

/// Writes a keyframe's line with its newline and returns the end; needs room for `max_keyframe_line_bytes`. Throws
/// std::invalid_argument for a value that is not finite.
char* write_keyframe_line(char* out, const Keyframe& keyframe, const TrajectoryHeader& header);
std::size_t max_keyframe_line_bytes(const TrajectoryHeader& header);

/// What one line after the header holds.
struct TrajectoryLine {
  bool is_end = false;
  Keyframe keyframe;
  TrajectoryEnd end;
};

/// Both throw InputError `trajectory_invalid` that begins with `where`, e.g. "line 7".
TrajectoryHeader parse_header_line(std::string_view text, const std::string& where);
TrajectoryLine parse_line(std::string_view text, const TrajectoryHeader& header, const std::string& where);

/// Does the run lie in the grid along one axis?
bool is_run(const Keyframe& keyframe, const Grid& grid);
/// Throws unless it does.
void check_run(const Keyframe& keyframe, const Grid& grid, const std::string& where);

}  // namespace sculpt
