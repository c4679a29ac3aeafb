// Corners -> how fast the path is gone through: backwards the largest speeds from which what follows can be kept,
// forwards the largest that can be come to.
#pragma once

#include <vector>

#include "core/timing/corners.hpp"
#include "core/timing/time_account.hpp"

namespace sculpt {

/// Sets x of all corners, and cruise where an edge is gone through slower all along; tells the time by what limits it.
/// `acceleration`: the law's. Linear in the number of points.
TimeAccount find_speeds(const PlanPath& path, const CornerDemands& demands, Corners& corners);

}  // namespace sculpt
