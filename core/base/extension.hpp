// The kind of a file, by its name.
#pragma once

#include <filesystem>
#include <string>

namespace sculpt {

/// What follows the last dot of its name, lower case: "stl" of "parts/Bust.STL"; empty if there is none.
std::string extension_of(const std::filesystem::path& file);

}  // namespace sculpt
