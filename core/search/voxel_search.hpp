// Voxel search for the translating robot (paper, section III-A): greedy best-first in voxel space, one instance for
// each separated section. The robot takes up one voxel and moves in six directions.
//
// A node of the paper's tree is (what is removed, where the robot is), ranked by h = voxels left + L1 to the nearest of
// them. Here a node is its parent and one move, and only the newest node is kept, so there is one voxel space that is
// changed in place. Nothing is lost by that: removing only adds to the air, so whatever can be reached from an ancestor
// can be reached from every one of its descendants; no node is a dead end, and the newest one has the fewest voxels
// left. Going back to an older node would mean to put material back. Going back in space is what may be needed, and
// that is a walk through voxels that are removed already.
// A move that removes is taken before any that does not: h alone would at times walk past a single voxel, which only
// puts it off.
//
// The stuck state of the paper's figure 3: the robot has cut its way into a pocket, all around it is kept or removed,
// and what is left lies elsewhere, perhaps just behind a wall. Every further node has the same voxels left and is no
// nearer, so plain best-first goes on with all older nodes, each with its own voxel space. They differ in nothing but
// the robot's place, so the same expansion by h is done over places instead: A* through air, with the paper's L1 term
// as its heuristic, to the nearest voxel by way (VoxelSpace::find_way). It visits an air voxel once at most and always
// ends.
#pragma once

#include <functional>

#include "core/base/watch.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/search/ground.hpp"
#include "core/search/run_writer.hpp"

namespace sculpt {

/// Removes every remove voxel that it comes to and may remove, one section after the other; `emit` gets the longest
/// straight runs in order. Every voxel passed by a travel is air or already removed. What would free a piece is set
/// aside and tried again when a neighbour is gone, and at the end as long as anything is cut. Deterministic. Takes 1.7
/// bytes a voxel of the grid, and time in proportion to the voxels passed. Throws Cancelled.
void carve_voxelwise(const VoxelGrid& voxels, const Ground& ground, const std::function<void(const VoxelRun&)>& emit,
                     const Watch& watch);
/// Goes on with the runs of `writer`, from where it is.
void carve_voxelwise(const VoxelGrid& voxels, const Ground& ground, RunWriter& writer, const Watch& watch);
/// From `translating_entry` and back to it, with nothing in the way and nothing to hold: all that is not enclosed.
void carve_voxelwise(const VoxelGrid& voxels, const std::function<void(const VoxelRun&)>& emit, const Watch& watch);

}  // namespace sculpt
