// The separated sections of what is to be removed, and where the search of each begins (paper, section III-A).
#pragma once

#include <functional>
#include <vector>

#include "core/search/voxel_tree.hpp"

namespace sculpt {

/// Moves the 6-connected section that holds `seed` from `waiting` to `section`. Returns its voxels on the sides and the
/// top of the grid of `n` voxels an edge. Calls `tick` every few voxels.
std::vector<Voxel> take_section(int n, Voxel seed, VoxelTree& waiting, VoxelTree& section,
                                const std::function<void()>& tick);

/// The one of `outer`, which must not be empty, nearest to a corner of the grid; of equals the one nearest to `from`,
/// then the lowest in z, y, x.
Voxel find_start(int n, const std::vector<Voxel>& outer, Voxel from);

}  // namespace sculpt
