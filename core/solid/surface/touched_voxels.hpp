// Which voxels a surface goes through.
#pragma once

#include "core/base/watch.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

/// The voxels of `grid` that hold any of a facet of `mesh` (metres, stock frame) in their inside: those that it only
/// touches with their sides, but for a millionth of an edge, are none. Throws Cancelled.
VoxelSet touched_voxels(const Mesh& mesh, const Grid& grid, const Watch& watch);

}  // namespace sculpt
