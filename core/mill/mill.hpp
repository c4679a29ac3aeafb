// `mill`: carves with real tools. Roughs along direction after direction, hands what is left from tool to tool.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/cell/cell.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mill/mill_stock.hpp"
#include "core/mill/tool_figures.hpp"
#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// What surfaces must be like (m).
struct MillWishes {
  double tolerance_m = 1e-4;  ///< of the surface: what may stand above it where the tools can come
  double scallop_m = 5e-5;    ///< of it, between rows
  double allowance_m = 3e-5;  ///< of it, left on purpose: what the cutter may stray is taken from this
};

/// What is milled; it must outlive the call.
struct MillJob {
  const Cell& cell;
  const Grid& grid;
  const VoxelGrid& voxels;
  const Mesh& part;  ///< placed, in metres, in the stock frame
  const std::vector<MillTool>& tools;
  MillWishes wishes;
  Configuration home;
};

struct MillResult {
  std::vector<ToolFigures> tools;
  VoxelSet left;      ///< not removed at the end
  VoxelSet standing;  ///< where something may stand then
};

/// The directions that a plan may hold its tools in, in the order of the trajectory's header.
const std::vector<Direction>& mill_directions();

/// Emits certified keyframes, in batches, and how many voxels each cut removes. Throws InputError, Cancelled.
MillResult mill(const MillJob& job, const std::function<void(std::vector<Keyframe>)>& emit, const RunContext& run);

}  // namespace sculpt
