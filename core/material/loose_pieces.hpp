// Which pieces of material hang on nothing. The stock is clamped to the table from below: what a face-connected path of
// standing voxels joins to layer k = 0 is held, everything else would fall.
#pragma once

#include <cstdint>

#include "core/material/voxel_grid.hpp"

namespace sculpt {

/// The standing voxels that hang on nothing.
VoxelSet find_loose(const VoxelSet& standing);

/// The parts of the finished sculpture that hang on nothing, with what they enclose: once all around them is gone
/// nothing can hold them.
VoxelSet find_unheld(const VoxelGrid& voxels);

/// Face-connected pieces of a set.
std::uint64_t count_pieces(const VoxelSet& voxels);

}  // namespace sculpt
