// A flood over faces of voxels, for the replay: rows of 64 voxels at a time, swept up and down the grid until nothing
// more is met. Internal to verify/, which shares no flood with the planners.
#pragma once

#include "core/material/voxel_set.hpp"

namespace sculpt {

/// The voxels of `open` that paths over faces inside it join to one of `seeds` that is in `open`, that one included.
/// Both n x n x n, n a power of two, n >= 4.
VoxelSet reached_through(const VoxelSet& open, VoxelSet seeds);

}  // namespace sculpt
