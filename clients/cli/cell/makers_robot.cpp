#include "clients/cli/cell/makers_robot.hpp"

#include "clients/cli/cell/xacro.hpp"
#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"
#include "core/cell/mesh_reference.hpp"
#include "core/doctor/make/urdf_text.hpp"

namespace sculpt::cli {
namespace {

namespace fs = std::filesystem;

const std::string package_scheme = "package://";

fs::path seen(const fs::path& path, const fs::path& folder) {
  return fs::absolute(path).lexically_normal().lexically_proximate(fs::absolute(folder).lexically_normal());
}

}  // namespace

RobotFolder::RobotFolder(const fs::path& urdf, const std::vector<std::string>& packages,
                         const std::vector<std::string>& without)
    : path_(urdf) {
  for (const std::string& package : packages) {
    const std::size_t equals = package.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Failure(exit_usage, "usage",
                    "--package " + package + ": write NAME=FOLDER, the folder of that ROS package");
    named_[package.substr(0, equals)] = package.substr(equals + 1);
  }
  text_ = read_input(urdf, "URDF");
  if (is_xacro(urdf, text_)) text_ = run_xacro(urdf, named_);
  for (const std::string& link : without) text_ = without_branch(text_, link);
}

MakersRobot RobotFolder::robot() const {
  return {text_, [this](const std::string& reference) { return read_mesh(reference); }};
}

std::string RobotFolder::read_mesh(const std::string& reference) const {
  const auto known = read_.find(reference);
  if (known != read_.end()) return known->second;
  const fs::path file = find_mesh_file(reference, path_, [this](const std::string& package) {
    const auto at = named_.find(package);
    return at == named_.end() ? std::nullopt : std::optional<fs::path>(at->second);
  });
  found_[reference] = file;
  return read_[reference] = read_input(file, "mesh");
}

std::string RobotFolder::seen_from(const fs::path& folder, std::string urdf) const {
  for (const auto& [reference, file] : found_)
    if (reference.find("://") == std::string::npos)
      urdf = with_reference(urdf, reference, seen(file, folder).generic_string());
  return urdf;
}

std::map<std::string, std::string> RobotFolder::packages(const fs::path& folder) const {
  std::map<std::string, std::string> packages;
  for (const auto& [reference, file] : found_) {
    if (!reference.starts_with(package_scheme)) continue;
    const fs::path inside = reference.substr(package_scheme.size());
    fs::path root = fs::absolute(file).lexically_normal();
    for (auto part = std::next(inside.begin()); part != inside.end(); ++part) root = root.parent_path();
    packages[inside.begin()->string()] = seen(root, folder).generic_string();
  }
  return packages;
}

}  // namespace sculpt::cli
