// .binvox files: run-length coded voxel sets (format: https://www.patrickmin.com/binvox/binvox.html).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/material/voxel_set.hpp"

namespace sculpt {

/// Header "#binvox 1", dim n n n, translate = `grid.origin_m`, scale = n * voxel_m, then data in the format's order (y
/// fastest, then z, then x).
std::string write_binvox(const VoxelSet& voxels, const Grid& grid);

/// Throws InputError `binvox_invalid` (names what is wrong: header, dimensions not cubic, runs too short or too
/// long...).
VoxelSet read_binvox(std::string_view bytes);

struct BinvoxHeader {
  int n = 0;                     ///< voxels along an edge of the grid
  std::optional<double> size_m;  ///< that edge, as `scale` says it
};

/// Throws InputError as read_binvox, of the header alone.
BinvoxHeader read_binvox_header(std::string_view bytes);

}  // namespace sculpt
