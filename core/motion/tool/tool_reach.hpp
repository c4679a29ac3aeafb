// What the tool alone could come to, whatever arm holds it.
#pragma once

#include <vector>

#include "core/base/watch.hpp"
#include "core/material/voxel_set.hpp"

namespace sculpt {

/// Of the `wanted` voxels, which stand in `standing` and are in the order of its indices, all that can never be
/// removed: ball and shank, as long as `length` voxel edges, fit along none of `steps` (as tool_steps gives them) even
/// when everything wanted is gone that they do fit at. All else stands. Exact for tools that fit through a voxel, but
/// that the shank's very end is not looked at. Throws Cancelled.
std::vector<Voxel> find_out_of_tool_reach(const VoxelSet& standing, const std::vector<Voxel>& wanted,
                                          const std::vector<Voxel>& steps, double length, const Watch& watch);

}  // namespace sculpt
