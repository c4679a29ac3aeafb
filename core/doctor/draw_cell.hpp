// A cell at one configuration, seen from three sides, side by side.
#pragma once

#include <vector>

#include "core/cell/cell.hpp"
#include "core/collision/near_bodies.hpp"
#include "core/picture/canvas.hpp"

namespace sculpt {

/// From the front and above, from the side (along +y of the room) and from above. Links as their collision shapes, the
/// stock, the tool (thicker than it is where it would not show) and the axes of the stock's cube at its lowest corner:
/// x red, y green, z blue. What `blocking` names is red all over. `height`: pixels; three times as wide. Any thread.
Picture draw_cell(const Cell& cell, const Configuration& q, const std::vector<NearBodies>& blocking, int height = 640);

}  // namespace sculpt
