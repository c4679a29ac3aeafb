// The directions a manipulator's tool is tried from.
#pragma once

#include <vector>

#include "core/base/frame.hpp"

namespace sculpt {

/// Unit vectors in the stock frame from the ball towards the spindle, none pointing down: +z, the four sides, then
/// those tilted by 45 degrees and along cube diagonals. In the order in which they are preferred.
inline std::vector<Vec3> tool_axes() {
  std::vector<Vec3> axes{{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  for (int z : {1, 0})
    for (int y : {-1, 0, 1})
      for (int x : {-1, 0, 1})
        if (const Vec3 axis(x, y, z); axis.squaredNorm() > 1) axes.push_back(axis.normalized());
  return axes;
}

}  // namespace sculpt
