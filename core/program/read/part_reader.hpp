// What a program says, read back from its text by code that shares nothing with what wrote it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/program/dialect.hpp"
#include "core/program/read/read_part.hpp"

namespace sculpt {

/// Whatever it must stop at is followed by what stops it, else the text is none. `axes`: how many. `letters`: their
/// names where the text names them. Throws InputError `program_damaged` with the line for a text that is none.
ReadPart read_part(Dialect dialect, std::string_view text, const std::vector<std::string>& letters);

}  // namespace sculpt
