// What one clamping leaves -> what the next one begins with.
#pragma once

#include "core/material/cube_turn.hpp"
#include "core/material/voxel_grid.hpp"

namespace sculpt {

/// `left`, what stands of `before`, and the target in it, turned about the middle of the grid and then set down, by
/// whole voxels, until what is left stands on the floor. Throws InputError `target_outside_stock` where a part of the
/// target is not in `left`.
VoxelGrid clamp_anew(const VoxelGrid& before, const VoxelSet& left, const CubeTurn& turn);

}  // namespace sculpt
