// The translating robot at work: search, robot and room together.
#pragma once

#include "core/base/run_context.hpp"
#include "core/material/voxel_set.hpp"
#include "core/motion/gantry/gantry.hpp"
#include "core/search/search.hpp"

namespace sculpt {

/// What a translating robot is to carve; it must outlive the call.
struct GantryTask {
  const VoxelSet& keep;
  const Configuration& home;
  Search search = Search::octree;      ///< or voxel
  const VoxelSet* may_fall = nullptr;  ///< only pieces of nothing but this may come free; null: any
};

/// Carves from home and back what the search comes to, or goes on with that at `start`, with the same keyframes that
/// would have followed. What stands in the robot's way it goes around; what it cannot come to, or may not, is left in
/// `scene`. Throws Cancelled, and InputError `no_transit` if there is no way home.
void carve_with_gantry(Scene& scene, const GantryTask& task, const GantryStart& start, const GantryListener& listener,
                       const RunContext& run);

}  // namespace sculpt
