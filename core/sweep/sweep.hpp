// The `sweep` planner: tool directions are chosen, rows are cut layer by layer, every edge is certified
// (docs/planner.md).
#pragma once

#include <functional>
#include <vector>

#include "core/base/watch.hpp"
#include "core/collision/scene.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/trajectory/trajectory.hpp"

namespace sculpt {

/// What sweeps leave standing.
struct SweepRest {
  VoxelSet standing;
  std::vector<Voxel>
      out_of_tool_reach;  ///< of it, what is to be removed but never can be, as find_out_of_tool_reach has it
};

/// Carves what the tool reaches along its axes, the straight and the tilted ones, from home and back to home.
/// `scene` holds the full stock and is not changed: what is free against all of it is free for ever. Every edge that
/// `emit` gets, a batch at a time on the calling thread, is certified. `may_fall`: what cannot be held. Deterministic,
/// also in `threads`. Throws Cancelled.
SweepRest carve_by_sweeps(const Scene& scene, const VoxelGrid& voxels, const VoxelSet& may_fall,
                          const Configuration& home, std::uint64_t seed, int threads,
                          const std::function<void(std::vector<Keyframe>)>& emit, const Watch& watch);

}  // namespace sculpt
