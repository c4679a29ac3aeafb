// The tool: a ball, a shank that runs from the ball's centre to the spindle, and the holder that grips the shank.
#pragma once

#include <vector>

#include "core/cell/robot.hpp"

namespace sculpt {

/// Lengths in metres. A tool without shank (the paper's translating robot) has shank_radius_m = stickout_m = 0.
struct Tool {
  double ball_radius_m = 0;
  double shank_radius_m = 0;
  double stickout_m = 0;  ///< from the tool link's origin to the ball's centre, along the tool link's +z
};

/// A cylinder or cone about the tool's axis; metres.
struct HolderSection {
  double length_m = 0;
  double radius_m = 0;      ///< at the spindle's end
  double end_radius_m = 0;  ///< at the ball's end
};

/// A tool as a cell file gives it: radii in metres, or in voxel edges so that it follows the resolution (the paper's
/// tool). The holder is always in metres, from the tool link's origin towards the ball.
struct ToolSpec {
  double ball_radius = 0.45;
  double shank_radius = 0.40;
  bool in_voxels = true;
  double stickout_m = 0;
  std::vector<HolderSection> holder = {};
  /// Of a milling tool that is guided by height maps: what it consists of, in the tool link's frame. The stock, and
  /// what stands still beside it, are then held against it (and all that is fixed to the tool link) by those maps.
  std::vector<Shape> body = {};

  bool is_guided_by_maps() const { return !body.empty(); }
};

/// Throws InputError `tool_too_large` when ball or shank would not fit through one voxel (radius >= 0.49 voxel), or the
/// holder leaves none of the ball free. `resolution`, where known, lets the refusal name the finest one that is
/// possible.
Tool make_tool(const ToolSpec& spec, double voxel_m, int resolution = 0);

/// The holder as cylinders in the tool link's frame, without gaps or overlaps: cones as several that hold them.
std::vector<Shape> holder_shapes(const ToolSpec& spec);

}  // namespace sculpt
