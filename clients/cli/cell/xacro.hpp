// Xacro sources, written out by the program `xacro` where it is installed.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace sculpt::cli {

/// By its name, or by an element of xacro in it.
bool is_xacro(const std::filesystem::path& path, const std::string& text);

/// What `xacro PATH` prints; packages are found where `packages` says and above the file. Throws Failure:
/// `xacro_missing` where there is no such program, `xacro_failed` with what it said.
std::string run_xacro(const std::filesystem::path& path, const std::map<std::string, std::filesystem::path>& packages);

}  // namespace sculpt::cli
