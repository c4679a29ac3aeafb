// Tool against material along an edge: ball and shank swept, bounded by exact end poses and a bound on the second
// derivative between.
#pragma once

#include <functional>

#include "core/cell/chain.hpp"
#include "core/cell/tool.hpp"
#include "core/collision/material.hpp"

namespace sculpt {

/// Ball's centre and the shank's other end, in voxel edges from the corner of voxel (0,0,0).
struct ToolLine {
  Vec3 ball, top;
};

/// Tool radii in voxel edges; shank 0 = none.
struct ToolRadii {
  double ball = 0, shank = 0;
};

/// The tool along an edge.
struct ToolEdge {
  ToolLine start, end;
  std::function<ToolLine(double)> line_at;  ///< at path parameter t in [0, 1]
  double second_derivative;                 ///< bound on that of any tool point by t, in voxel edges
};

/// True only if the tool stays clear of all material but `exempt` by `margin` (voxel edges) at every t.
bool tool_sweep_is_free(const Material& material, const ToolEdge& edge, const ToolRadii& radii, double margin,
                        const Exempt& exempt);

}  // namespace sculpt
