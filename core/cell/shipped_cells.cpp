#include "core/cell/shipped_cells.hpp"

#include <cstdlib>
#include <set>

namespace sculpt {

std::vector<std::filesystem::path> shipped_cell_folders() {
  namespace fs = std::filesystem;
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

}  // namespace sculpt
