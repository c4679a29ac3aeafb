// What the program says that calls the parts, read back from its text by code that shares nothing with what wrote it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/program/dialect.hpp"

namespace sculpt {

/// The names of the parts in the order in which they are called. `data`: of KRL the text of its .dat. Throws InputError
/// `program_damaged` where the number of the next part would not outlive a power cut, a part is called at another
/// number than its own, the number does not rise behind each part, or does not begin anew behind the last one.
std::vector<std::string> read_main(Dialect dialect, std::string_view text, std::string_view data = {});

}  // namespace sculpt
