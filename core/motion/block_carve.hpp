// The inner search of the paper (section III-C): removes the voxels of one block with the manipulator.
#pragma once

#include <vector>

#include "core/material/octree.hpp"
#include "core/motion/arm.hpp"
#include "core/search/block_order.hpp"

namespace sculpt {

/// Greedy best-first over the block's standing voxels with an open face; prefers near ones, then those in line with the
/// last step, then those not towards the inside of the block. A voxel that would free a piece of material is not tried.
/// What was cut stays cut, also when some voxels cannot be reached now (material only shrinks).
BlockTrial carve_block(Arm& arm, const Block& block, int effort);

/// To which voxels of the block the arm would come down from elsewhere now, and along which axes, in this order.
/// Several threads may ask while the arm does nothing.
std::vector<Arm::Descent> find_descents(const Arm& arm, const Block& block, int effort);

}  // namespace sculpt
