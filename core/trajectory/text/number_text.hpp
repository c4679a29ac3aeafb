// Numbers as a trajectory's text has them. Internal to trajectory/.
#pragma once

#include <string>

namespace sculpt {

inline constexpr int max_number_bytes = 24;

/// Writes the shortest decimal form that reads back as the same double, byte for byte what std::to_chars gives, but
/// several times faster for multiples of the quantum; -0 becomes 0. Returns the end; needs room for `max_number_bytes`.
/// Throws std::invalid_argument for a value that is not finite: that is a planner's bug, not bad input.
char* write_number(char* out, double value);
void append_number(std::string& text, double value);

}  // namespace sculpt
