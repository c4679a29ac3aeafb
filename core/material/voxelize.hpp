// Mesh -> VoxelSet: parity of crossings along columns, with a vote over the three axes where columns disagree.
#pragma once

#include "core/base/watch.hpp"
#include "core/material/mesh.hpp"
#include "core/material/voxel_set.hpp"

namespace sculpt {

/// The voxels of `grid` whose centre is inside `mesh` (metres, stock frame). A mesh with small holes works: where a column of one
/// axis has an odd number of crossings the other two axes decide. Throws InputError `mesh_not_solid` with the share of
/// inconsistent columns when the mesh encloses nothing or too many columns are inconsistent; Cancelled.
VoxelSet voxelize(const Mesh& mesh, const Grid& grid, const Watch& watch);

}  // namespace sculpt
