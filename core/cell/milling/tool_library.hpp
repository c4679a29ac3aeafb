// A tool library file -> the tools of a job.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/cell/milling/mill_tool.hpp"

namespace sculpt {

/// A library as bytes, so that it can be sent to a machine that does not share this disk.
struct ToolLibraryFile {
  std::string name;  ///< of the file, without its extension
  std::string json;
};

/// All tools of a library, in its order. Throws InputError `tools_invalid` with the JSON pointer of what is wrong with
/// a tool, its value and the cure: lengths that cannot be (also those that were meant in millimetres), a cutter that
/// does not fit its flutes, a holder thinner than its shank.
std::vector<MillTool> parse_tool_library(const ToolLibraryFile& file);

/// Those that a job names, in its order, which is the order that they are used in. Throws InputError `tools_invalid`
/// for a tool that is not there (lists those that are) or is named twice, for none and for more than `max_tools`.
std::vector<MillTool> choose_tools(const ToolLibraryFile& file, const std::vector<std::string>& names);

inline constexpr std::size_t max_tools = 16;

/// The folder that the environment variable SCULPT_TOOLS names, else the folders `tools` beside these of cells.
std::vector<std::filesystem::path> tool_folders(std::vector<std::filesystem::path> cells);
/// Those of the shipped cells.
std::vector<std::filesystem::path> shipped_tool_folders();
/// All libraries in the folders that can be read, by name; of one name that which read_tool_library finds.
std::vector<ToolLibraryFile> read_tool_libraries(const std::vector<std::filesystem::path>& folders);

/// `library`: a path to a file (anything with a '/' or ending in .json), else a name looked up in each of `folders`.
/// Throws InputError `tools_invalid` (lists the names there are), `file_missing`.
ToolLibraryFile read_tool_library(const std::string& library, const std::vector<std::filesystem::path>& folders);

}  // namespace sculpt
