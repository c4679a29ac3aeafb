// The carving of a job: which planner does it, and where it goes on.
#pragma once

#include <vector>

#include "core/base/run_context.hpp"
#include "core/collision/scene.hpp"
#include "core/material/octree.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/motion/posture_atlas.hpp"
#include "core/plan/run_log.hpp"
#include "core/search/search.hpp"
#include "core/sweep/field/field_store.hpp"
#include "core/trajectory/header.hpp"

namespace sculpt {

/// What is carved; it must outlive the call.
struct CarveTask {
  const VoxelGrid& voxels;
  const Octree& octree;      ///< of them
  const VoxelSet& may_fall;  ///< what cannot be held
  const TrajectoryHeader& header;
  const PostureAtlas& atlas;  ///< of the scene's chain and grid
  FieldStore fields;          ///< of the scene, home and seed
  Search search;              ///< octree or voxel where the chain only translates, else sweep or octree
};

/// What an earlier run carved.
struct Carved {
  VoxelSet standing;             ///< after sweeping, or after as much of it as was done; the stock if nothing was
  Configuration q;               ///< where it stopped then
  std::vector<Keyframe> by_arm;  ///< what an arm did since, block by block
};

/// Carves what the robot can, with the planner of `task`; `scene` loses what it removes block by block or as a
/// translating robot. Goes on after `before`, at the checkpoint of `log`, which hears of everything. Throws Cancelled,
/// and InputError `no_transit` if there is no way home.
void carve(Scene& scene, const CarveTask& task, const Carved& before, RunLog& log, const RunContext& run);

}  // namespace sculpt
