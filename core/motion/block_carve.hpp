// The inner search of the paper (section III-C): removes the voxels of one block with the manipulator.
#pragma once

#include "core/material/octree.hpp"
#include "core/motion/arm.hpp"
#include "core/search/block_order.hpp"

namespace sculpt {

/// Greedy best-first over the block's standing voxels with an open face; prefers near ones, then those in line with the
/// last step, then those not towards the inside of the block. A voxel that would free a piece of material is not tried.
/// What was cut stays cut, also when some voxels cannot be reached now (material only shrinks).
BlockTrial carve_block(Arm& arm, const Block& block, int effort);

}  // namespace sculpt
