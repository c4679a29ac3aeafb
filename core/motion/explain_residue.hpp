// What was left of a plan -> Residue: why, voxel by voxel.
#pragma once

#include <vector>

#include "core/base/run_context.hpp"
#include "core/collision/scene.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/motion/posture_atlas.hpp"
#include "core/motion/residue.hpp"

namespace sculpt {

/// The remove voxels of `voxels` that still stand in `scene`, in index order, each with the first condition that no
/// tool axis meets in the final state: joined to the outside; room for ball, shank and holder; a configuration at all;
/// one within limits; one without contact. What meets all of them was left because its removal would free a loose
/// piece, or else for want of a transit. What only stands behind such voxels says so. `may_fall`: what cannot be held;
/// `atlas`: of the scene's chain and grid. Throws Cancelled.
std::vector<Residue> explain_residue(const Scene& scene, const PostureAtlas& atlas, const VoxelGrid& voxels,
                                     const VoxelSet& may_fall, const RunContext& run);

}  // namespace sculpt
