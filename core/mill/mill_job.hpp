// What is milled, and how.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/cell/cell.hpp"
#include "core/cell/milling/mill_tool.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mill/map/tool_frame.hpp"

namespace sculpt {

/// What surfaces must be like (m).
struct MillWishes {
  double tolerance_m = 1e-4;  ///< of the surface: what may stand above it where the tools can come
  double scallop_m = 3.5e-5;  ///< of it, between rows
  double allowance_m = 1e-5;  ///< of it, left on purpose: what the cutter may stray is taken from this

  /// How far the cutter may stray from a straight way while it cuts.
  double stray_m() const { return std::min(2e-5, 2 * allowance_m / 3); }
  /// Between rows of a ball over a plane, which leave the scallop: r - sqrt(r^2 - s^2 / 4), nearly.
  double stepover_m(double radius_m) const { return std::sqrt(8 * scallop_m * radius_m); }
  /// How far an edge may be above what it should follow.
  double chord_m() const { return 0.1 * tolerance_m; }
};

/// It must outlive whoever works on it.
struct MillJob {
  const Cell& cell;
  const Grid& grid;
  const VoxelGrid& voxels;
  const Mesh& part;  ///< placed, in metres, in the stock frame
  const std::vector<MillTool>& tools;
  MillWishes wishes;
  Configuration home, change;  ///< change: where tools are changed
};

/// The directions that a plan may hold its tools in, in the order of the trajectory's header.
const std::vector<Direction>& mill_directions();

}  // namespace sculpt
