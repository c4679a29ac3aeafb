// Octree search for the translating robot (paper, section III-B): blocks by greedy best-first over the octree-graph,
// boustrophedon inside blocks.
#pragma once

#include <functional>

#include "core/material/block_graph.hpp"
#include "core/search/ground.hpp"

namespace sculpt {

/// One straight run along one axis. A cut removes every voxel first..last; the robot stands at a face neighbour of
/// `first` on the run's own line or turns into it from one. A travel goes from `first`, where the robot stands, to
/// `last` through air.
struct VoxelRun {
  bool cut = false;
  Voxel first, last;
};

/// Above the corner of the grid: where paths start and end if nothing is there. Positions may leave the grid
/// by one voxel at the sides and above, never below the floor.
inline Voxel translating_entry(int n) {
  return {0, 0, n};
}

/// Removes the blocks that can go whole, again and again as long as any does, then of the rest what `carve_voxelwise`
/// can; `emit` gets the runs in order. Deterministic. Throws Cancelled. Every voxel passed by a travel is air or
/// already removed; consecutive runs join up.
void carve_translating(const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph, const Ground& ground,
                       const std::function<void(const VoxelRun&)>& emit, const Watch& watch);
/// From `translating_entry` and back to it, with nothing in the way and nothing to hold: all that is not enclosed.
void carve_translating(const VoxelGrid& voxels, const Octree& octree, const BlockGraph& graph,
                       const std::function<void(const VoxelRun&)>& emit, const Watch& watch);

}  // namespace sculpt
