// A maker's URDF and its meshes on this disk, as `cell new` reads them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/doctor/make/new_cell.hpp"

namespace sculpt::cli {

/// What lies where, seen from the folder that the new cell goes to.
class RobotFolder {
 public:
  /// `urdf`: a URDF, or a xacro source, which is written out by the program `xacro`. `packages`: NAME=FOLDER each.
  /// `without`: links to be taken out, with all that hangs on them. Throws Failure and InputError.
  RobotFolder(const std::filesystem::path& urdf, const std::vector<std::string>& packages,
              const std::vector<std::string>& without);

  /// The object must outlive it.
  MakersRobot robot() const;
  /// `urdf` with the paths that the maker wrote beside it as they are seen from `folder`.
  std::string seen_from(const std::filesystem::path& folder, std::string urdf) const;
  /// The packages whose meshes were read, as seen from `folder`.
  std::map<std::string, std::string> packages(const std::filesystem::path& folder) const;

 private:
  std::string read_mesh(const std::string& reference) const;

  std::filesystem::path path_;
  std::string text_;
  std::map<std::string, std::filesystem::path> named_;
  mutable std::map<std::string, std::filesystem::path> found_;  // files of meshes by their reference
  mutable std::map<std::string, std::string> read_;
};

}  // namespace sculpt::cli
