// A cell at another stand as files: the cell file and its URDF, which differ from the old ones in nothing else.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/place/stand.hpp"

namespace sculpt {

struct PlacedCell {
  std::string cell_json;  ///< names `urdf_name` beside it
  std::string urdf_name, urdf;
};

/// A cell as its files say it, and where they are.
struct CellSource {
  CellFiles files;
  std::filesystem::path path;  ///< of the cell file
  Cell cell;                   ///< parsed
};

/// The new cell file is to be `to`. References to meshes and packages are written anew where the folder is another one.
/// `home`: in coordinates of the chain, where it is another one. Throws InputError `urdf_invalid`, `file_missing`.
PlacedCell place_cell(const CellSource& source, int joint, const Stand& stand, const std::optional<Configuration>& home,
                      const std::filesystem::path& to);

}  // namespace sculpt
