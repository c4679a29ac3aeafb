// A curve with fewer corners.
#pragma once

#include "core/mill/map/level_curves.hpp"

namespace sculpt {

/// No corner that is left out is farther from it than `off_m`; its ends stay, and of a ring one corner more (Ramer,
/// "An iterative procedure for the polygonal approximation of plane curves", CGIP 1, 1972).
Curve simplified(const Curve& curve, double off_m);

}  // namespace sculpt
