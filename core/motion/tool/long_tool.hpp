// What a tool that is longer than the grid comes to along one direction, whole rows of voxels at a time.
#pragma once

#include "core/material/voxel_set.hpp"

namespace sculpt {

/// Takes out of `standing` those of `wanted` that ball and shank fit at along `lean`, from the ball outwards, once what
/// is wanted and in their way is gone; what is in their way is what ToolShadow says. One sweep in from outside decides
/// it, for nothing nearer to the ball is ever in the way. Each component of `lean` is 0, 1 or -1, it does not point
/// down; n is a power of two, at least 4. Says whether anything was taken.
bool peel_along(Voxel lean, const VoxelSet& wanted, VoxelSet& standing);

}  // namespace sculpt
