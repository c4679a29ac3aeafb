// Where cells lie, those that come with the program and those of the user.
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

/// `cell`: a path to a cell file (anything with a '/' or ending in .json), else a name looked up in each of `folders`.
/// Throws InputError `cell_unknown` (lists the names there are).
std::filesystem::path find_cell(const std::string& cell, const std::vector<std::filesystem::path>& folders);

}  // namespace sculpt
