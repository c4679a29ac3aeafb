// Mesh -> the voxels inside: signs of crossings along columns, with a vote over the three axes where columns disagree.
#pragma once

#include "core/base/watch.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

struct Solid {
  VoxelSet inside;
  Ambiguous ambiguous;
};

/// The voxels of `grid` whose centre is inside `mesh` (metres, stock frame): in a body and in none of its cavities
/// (turn_shells). Bodies may overlap. A mesh with small holes works: where a column of one axis has an odd number of
/// crossings the other two axes decide. Throws InputError `mesh_not_solid`, with the share of inconsistent columns and
/// the largest hole, when the mesh encloses nothing or too many columns are inconsistent; Cancelled.
Solid find_solid(const Mesh& mesh, const Grid& grid, const Watch& watch);

inline VoxelSet voxelize(const Mesh& mesh, const Grid& grid, const Watch& watch) {
  return find_solid(mesh, grid, watch).inside;
}

}  // namespace sculpt
