// The tool: a ball, and a shank that runs from the ball's centre to the spindle.
#pragma once

#include <optional>

namespace sculpt {

/// Lengths in metres. A tool without shank (the paper's translating robot) has shank_radius_m = stickout_m = 0.
struct Tool {
  double ball_radius_m = 0;
  double shank_radius_m = 0;
  double stickout_m = 0;  ///< from the tool link's origin to the ball's centre, along the tool link's +z
};

/// A tool as a cell file gives it: radii in metres, or in voxel edges so that it follows the resolution (the paper's tool).
struct ToolSpec {
  double ball_radius = 0.45;
  double shank_radius = 0.40;
  bool in_voxels = true;
  double stickout_m = 0;
};

/// Throws InputError `tool_too_large` when ball or shank would not fit through one voxel (radius >= 0.49 voxel).
Tool make_tool(const ToolSpec& spec, double voxel_m);

}  // namespace sculpt
