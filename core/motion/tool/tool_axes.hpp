// The directions a manipulator's tool is tried from.
#pragma once

#include <vector>

#include "core/material/voxel.hpp"

namespace sculpt {

/// From the ball towards the spindle, in voxels of the grid, none pointing down: +z, the four sides, then those tilted
/// by 45 degrees and along cube diagonals. In the order in which they are preferred.
inline std::vector<Voxel> tool_steps() {
  std::vector<Voxel> steps{{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  for (int z : {1, 0})
    for (int y : {-1, 0, 1})
      for (int x : {-1, 0, 1})
        if (l1({x, y, z}, {}) > 1) steps.push_back({x, y, z});
  return steps;
}

/// The same as unit vectors, in the stock frame.
inline std::vector<Vec3> tool_axes() {
  std::vector<Vec3> axes;
  for (const Voxel step : tool_steps()) axes.push_back(Vec3(step.i, step.j, step.k).normalized());
  return axes;
}

}  // namespace sculpt
