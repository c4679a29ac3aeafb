// Where the columns of one axis cross the surface of a mesh.
#pragma once

#include "core/material/voxel_grid.hpp"

namespace sculpt {

/// Columns of `axis` run through voxel centres. A column is named (a, b): its coordinates on the axes after `axis` and
/// after that (x -> y, z; y -> z, x; z -> x, y); its bit is a + n b. Which facets a column goes through is exact: one
/// through an edge or a vertex counts as if moved by an infinitesimal step, so that a closed surface never leaves an
/// odd column.
struct Crossings {
  VoxelSet inside;                 ///< where solids wind round more often than cavities
  std::vector<std::uint64_t> met;  ///< columns with any crossing
  std::vector<std::uint64_t> odd;  ///< columns with an odd number of crossings: what they say cannot be trusted
  /// Columns with an even number whose signs do not cancel: even and odd decides in them.
  std::uint64_t unbalanced = 0;
  /// Voxels in a doubtful shell where signs say one thing, even and odd another.
  Ambiguous ambiguous;

  bool is_odd(std::size_t column) const { return (odd[column >> 6] >> (column & 63)) & 1; }
};

}  // namespace sculpt
