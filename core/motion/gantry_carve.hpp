// The translating robot at work: search, robot and room together.
#pragma once

#include <string>

#include "core/base/watch.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/motion/gantry.hpp"

namespace sculpt {

/// Carves from home and back what `search` (octree, else voxel) comes to. What stands in the robot's way it goes
/// around; what it cannot come to, or may not, is left in `scene`. Only pieces of nothing but `may_fall` may come free;
/// null: any. Throws Cancelled, and InputError `no_transit` if there is no way home.
void carve_with_gantry(Gantry& gantry, const Scene& scene, const VoxelSet& keep, const Configuration& home,
                       const std::string& search, const VoxelSet* may_fall, const Watch& watch);

}  // namespace sculpt
