// Where the mesh files lie that a URDF names.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace sculpt {

/// `reference`: a path beside `urdf`, file://PATH, or package://NAME/REST. A package is looked for where `named` says,
/// if it does, else in each folder above the URDF (NAME itself or a sub-folder NAME), else in ROS_PACKAGE_PATH. Throws
/// InputError `file_missing` if it is in none.
std::filesystem::path find_mesh_file(
    const std::string& reference, const std::filesystem::path& urdf,
    const std::function<std::optional<std::filesystem::path>(const std::string& package)>& named);

}  // namespace sculpt
