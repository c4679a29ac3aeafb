// Rows along the middle of narrow surface: creases, and what rings leave between them.
#pragma once

#include <vector>

#include "core/mill/finish/rows/plan_patch.hpp"
#include "core/mill/map/level_curves.hpp"

namespace sculpt {

/// From end to end of a patch, with its branches, one after the other: the skeleton that thinning leaves of it (Guo,
/// Hall, "Parallel thinning with two-subiteration algorithms", Comm. ACM 32, 1989), smoothed. Where places of
/// `exact` are near a curve it goes through these. What is one spacing wide needs no more than its curve.
std::vector<Curve> middle_curves(PlanPatch patch, const std::vector<Point2>& exact, double spacing_m);

}  // namespace sculpt
