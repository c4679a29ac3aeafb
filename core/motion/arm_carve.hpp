// The manipulator at work: the outer search over blocks, the inner one within them, and the arm together.
#pragma once

#include <functional>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/material/octree.hpp"
#include "core/motion/arm.hpp"
#include "core/search/block_order.hpp"

namespace sculpt {

/// Where an arm goes on: what came of the blocks that another one tried, its keyframes, and what it knew then.
struct ArmStart {
  std::vector<BlockTrial> trials;
  const std::vector<Keyframe>& keyframes;
  ArmMemory memory;
};

/// What an arm is to carve, and from where; it must outlive the call.
struct ArmTask {
  const Octree& octree;
  const PostureAtlas& atlas;  ///< of the scene's chain and grid
  const VoxelSet& may_fall;   ///< what cannot be held
  const Configuration& home;
};

/// Who hears of an arm.
struct ArmListener {
  std::function<void(const Keyframe&)> emit;
  std::function<void(const BlockTrial&, const ArmMemory&)> tried;  ///< another could go on here
};

/// Carves the blocks of an octree from home and back, or goes on with that at `start`, with the same keyframes that
/// would have followed. What it cannot come to is left in `scene`. Gives what the arm knows at the end. Throws
/// Cancelled.
ArmMemory carve_with_arm(Scene& scene, const ArmTask& task, const ArmStart& start, const ArmListener& listener,
                         const RunContext& run);

}  // namespace sculpt
