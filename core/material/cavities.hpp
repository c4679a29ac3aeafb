// Which voxels no tool can ever come to, whatever its shape.
#pragma once

#include "core/material/voxel_grid.hpp"

namespace sculpt {

/// The remove voxels that no face-connected path of voxels outside `keep` joins to the outside of the grid. The floor
/// (below k = 0) is no entrance.
VoxelSet find_enclosed(const VoxelGrid& voxels);

}  // namespace sculpt
