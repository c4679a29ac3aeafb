// Octree search for the translating robot (paper, section III-B): blocks by greedy best-first over the octree-graph,
// boustrophedon inside blocks.
#pragma once

#include <functional>

#include "core/material/block_graph.hpp"
#include "core/search/ground.hpp"
#include "core/search/voxel_run.hpp"

namespace sculpt {

/// Removes the blocks that can go whole, again and again as long as any does, then of the rest what `carve_voxelwise`
/// can; `emit` gets the runs in order. Deterministic. Throws Cancelled. Every voxel passed by a travel is air or
/// already removed; consecutive runs join up.
void carve_translating(const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph, const Ground& ground,
                       const std::function<void(const VoxelRun&)>& emit, const Watch& watch);
/// From `translating_entry` and back to it, with nothing in the way and nothing to hold: all that is not enclosed.
void carve_translating(const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph,
                       const std::function<void(const VoxelRun&)>& emit, const Watch& watch);

}  // namespace sculpt
