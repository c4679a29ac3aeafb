// A part in FANUC's LS. Internal to read/.
#pragma once

#include <string_view>

#include "core/program/read/read_part.hpp"

namespace sculpt {

/// As read_part.
ReadPart read_fanuc(std::string_view text, std::size_t axes);

}  // namespace sculpt
