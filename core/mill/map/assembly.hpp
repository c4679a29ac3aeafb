// All that moves with a milling tool, as it is seen from below: how high it is at a distance from the axis.
#pragma once

#include <vector>

#include "core/cell/cell.hpp"
#include "core/cell/milling/mounted_tool.hpp"

namespace sculpt {

/// From `height_m` above the tip on, something is as far from the axis as `radius_m`.
struct Ring {
  double radius_m, height_m;
};

/// What is above a point of the tool counts as part of it: whoever comes down the axis meets that first.
struct Assembly {
  MillTool tool;
  /// Neck, shank, holder, and what the tool link carries besides, as flat rings: both values grow from ring to ring.
  std::vector<Ring> rings;

  double radius_m() const { return std::max(tool.cutter.radius_m, rings.empty() ? 0 : rings.back().radius_m); }
  /// How far from the tip it goes up or sideways, at most.
  double reach_m = 0;
};

/// Of `cell` with this tool in its spindle. Shapes fixed to the tool link count as turned about the axis.
Assembly make_assembly(const Cell& cell, const MillTool& tool);

/// `cell` with the tool in its spindle, for fields of postures: what is fixed to the tool link is not held against the
/// stock, nor the tool against what stands still in the stock's frame: height maps do that.
Cell guided_by_maps(const Cell& cell, const MillTool& tool);

}  // namespace sculpt
