#include "core/cell/shipped_cells.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "core/base/error.hpp"

namespace sculpt {

namespace fs = std::filesystem;

std::vector<std::filesystem::path> shipped_cell_folders() {
  if (const char* named = std::getenv("SCULPT_CELLS")) return {named};
  std::error_code failed;
  for (const fs::path& start : {fs::read_symlink("/proc/self/exe", failed).parent_path(), fs::current_path(failed)})
    for (fs::path at = start; at.has_relative_path(); at = at.parent_path())
      for (const char* place : {"config/cells", "share/sculptd/cells"})
        if (fs::is_directory(at / place, failed)) return {at / place};
  return {};
}

std::vector<std::string> cell_names(const std::vector<std::filesystem::path>& folders) {
  std::set<std::string> names;
  for (const std::filesystem::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
      if (entry.path().extension() == ".json") names.insert(entry.path().stem().string());
  }
  return {names.begin(), names.end()};
}

fs::path find_cell(const std::string& cell, const std::vector<fs::path>& folders) {
  if (cell.find('/') != std::string::npos || cell.ends_with(".json")) return cell;
  std::vector<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / (cell + ".json"), ignored)) return folder / (cell + ".json");
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  if (folders.empty())
    throw InputError("cell_unknown",
                     "there is no cell '" + cell +
                         "': no folder config/cells was found above the program or the working folder; set "
                         "SCULPT_CELLS to it, or give the path of a cell file (with a '/' or ending in .json)");
  throw InputError("cell_unknown", "there is no cell '" + cell + "'; known cells: " + (list.empty() ? "none" : list) +
                                       "; or give the path of a cell file (with a '/' or ending in .json)");
}

}  // namespace sculpt
