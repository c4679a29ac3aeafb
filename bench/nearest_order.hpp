// Plain nearest neighbour for the translating robot: what the planners' orders are compared with. No planner of the
// product.
#pragma once

#include <functional>

#include "core/search/translating.hpp"

namespace sculpt {

/// Always goes to the remove voxel with the shortest way through air, and cuts it; of equals the lowest in z, y, x.
/// What is removed and what `emit` gets is as for `carve_voxelwise`. Deterministic. Throws Cancelled.
void carve_nearest(const VoxelGrid& voxels, const std::function<void(const VoxelRun&)>& emit, const Watch& watch);

}  // namespace sculpt
