#include "core/cell/mesh_reference.hpp"

#include <cstdlib>
#include <sstream>
#include <vector>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

/// Folders that may be the ROS package `package`, beside the one that is named.
std::vector<fs::path> package_folders(const std::string& package, const fs::path& urdf) {
  std::vector<fs::path> folders;
  for (fs::path above = fs::absolute(urdf).lexically_normal().parent_path(); above.has_relative_path();
       above = above.parent_path()) {
    if (above.filename() == package) folders.push_back(above);
    folders.push_back(above / package);
  }
  if (const char* roots = std::getenv("ROS_PACKAGE_PATH")) {
    std::istringstream list(roots);
    for (std::string root; std::getline(list, root, ':');) {
      if (root.empty()) continue;
      if (fs::path(root).filename() == package) folders.emplace_back(root);
      folders.push_back(fs::path(root) / package);
    }
  }
  return folders;
}

}  // namespace

fs::path find_mesh_file(const std::string& reference, const fs::path& urdf,
                        const std::function<std::optional<fs::path>(const std::string& package)>& named) {
  const std::string package_scheme = "package://", file_scheme = "file://";
  if (reference.starts_with(file_scheme)) return reference.substr(file_scheme.size());
  if (!reference.starts_with(package_scheme)) return urdf.parent_path() / reference;
  const std::string path = reference.substr(package_scheme.size());
  const std::size_t slash = path.find('/');
  const std::string package = path.substr(0, slash);
  const std::string rest = slash == std::string::npos ? "" : path.substr(slash + 1);
  std::vector<fs::path> folders = package_folders(package, urdf);
  if (const auto first = named(package)) folders.insert(folders.begin(), *first);
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / rest, ignored)) return folder / rest;
  }
  throw InputError("file_missing",
                   "mesh '" + reference + "' was not found: add \"packages\": {\"" + package +
                       "\": \"folder\"} to the cell file, or put the package's folder into ROS_PACKAGE_PATH");
}

}  // namespace sculpt
