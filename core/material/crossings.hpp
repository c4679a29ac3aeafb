// Where the columns of one axis cross the surface of a mesh.
#pragma once

#include "core/base/watch.hpp"
#include "core/material/mesh.hpp"
#include "core/material/voxel_set.hpp"

namespace sculpt {

/// Columns of `axis` run through voxel centres. A column is named (a, b): its coordinates on the axes after `axis` and
/// after that (x -> y, z; y -> z, x; z -> x, y); its bit is a + n b.
struct Crossings {
  VoxelSet inside;                 ///< parity from the low end of each column
  std::vector<std::uint64_t> met;  ///< columns with any crossing
  std::vector<std::uint64_t> odd;  ///< columns with an odd number of crossings: their parity cannot be trusted

  bool is_odd(std::size_t column) const { return (odd[column >> 6] >> (column & 63)) & 1; }
};

/// Vertices in 1/65536 of a voxel edge, relative to the grid's corner. Parity is exact on these integers: a column
/// through an edge or a vertex counts as if moved by an infinitesimal step, so that a closed surface never leaves an
/// odd column.
constexpr int unit_bits = 16;
struct FixedMesh {
  std::vector<std::array<std::int64_t, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Throws InputError `target_outside_stock` for a mesh that reaches out of the grid so far that the integers would
/// overflow.
FixedMesh to_fixed(const Mesh& mesh, const Grid& grid);

Crossings find_crossings(const FixedMesh& mesh, int n, int axis, const Watch& watch);

}  // namespace sculpt
