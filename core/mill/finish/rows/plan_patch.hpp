// The surface that balls rest on, as it is seen along the tool's axis.
#pragma once

#include <vector>

#include "core/mill/finish/nails.hpp"
#include "core/mill/finish/rows/resting_ball.hpp"
#include "core/mill/map/lattice.hpp"
#include "core/mill/map/tool_frame.hpp"

namespace sculpt {

struct PlanPatch {
  Lattice lattice;              ///< with at least two cells around the patch
  std::vector<char> is_inside;  ///< of each cell
  std::vector<Point2> slopes;   ///< of each cell inside: of the surface that balls' middles are on (m/m, along u and v)
};

struct PatchTask {
  double step_m = 0;        ///< of the lattice
  double reach_m = 0;       ///< along the surface, from where a ball rests
  double jump_m = 0;        ///< where one surface is so far behind another the patch ends
  double least_cosine = 0;  ///< what leans more from the axis counts as leaning so
};

/// What is no farther than the reach from where some balls rest. The surface goes on around each as its nail lies.
PlanPatch make_patch(const PatchTask& task, const ToolFrame& frame, const Nails& nails,
                     const std::vector<RestingBall>& balls);

}  // namespace sculpt
