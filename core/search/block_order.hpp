// The outer search over the octree-graph (paper, section III-C): which block next. Knows no robot: removing is a
// parameter.
#pragma once

#include <functional>
#include <span>

#include "core/material/block_graph.hpp"

namespace sculpt {

/// What came of trying a block: voxels removed now, voxels still standing in it, and where the tool is afterwards.
struct BlockTrial {
  int removed = 0;
  int left = 0;
  Voxel at;
};

/// Removes what can be removed of `block` in the present state; `effort` rises from 0 when cheaper attempts are used
/// up.
using TryBlock = std::function<BlockTrial(int block, int effort)>;

/// Hears which blocks will be tried next while nothing is removed of any, so that what they need can be found out side
/// by side.
using Foresee = std::function<void(std::span<const int> blocks, int effort)>;

/// Greedy best-first: of the blocks with an open face the one with the least h = voxels left + L1 distance from the
/// tool (paper, eq. 1). A block that could not be removed whole is set aside until a neighbour is gone; when none is
/// open those set aside are tried again while anything changes, then with more effort, up to `max_effort`. Material
/// only shrinks, so nothing is ever undone and the search needs no backtracking (docs/planner.md). Every remove block
/// is done or was tried in vain in the final state. Throws Cancelled through `watch`.
void order_blocks(const Octree& octree, const BlockGraph& graph, Voxel start, int max_effort, const TryBlock& try_block,
                  const Watch& watch, const Foresee& foresee = {});

}  // namespace sculpt
