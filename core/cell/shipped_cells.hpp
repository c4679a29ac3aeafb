// Where the cells that come with the program lie.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sculpt {

/// The folder that the environment variable SCULPT_CELLS names, else the first `config/cells` or `share/sculptd/cells`
/// in a folder above this program (source tree or installed) or above the working folder; none if there is no such
/// folder.
std::vector<std::filesystem::path> shipped_cell_folders();

/// The names of the cells in these folders, sorted.
std::vector<std::string> cell_names(const std::vector<std::filesystem::path>& folders);

}  // namespace sculpt
