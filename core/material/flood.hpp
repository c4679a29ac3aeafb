// Flood through a voxel set, a row of machine words at a time.
#pragma once

#include "core/material/voxel_set.hpp"

namespace sculpt {

/// Where the flood comes from: beside and above the grid (never below it), or the floor alone.
enum class FloodFrom { sides_and_top, floor };

/// The voxels of `open` that face-connected paths inside `open` join to the entrance. Needs n a power of two, n >= 4.
VoxelSet flood(const VoxelSet& open, FloodFrom entrance);

}  // namespace sculpt
