// Rows side by side over a surface.
#pragma once

#include <vector>

#include "core/mill/finish/rows/plan_patch.hpp"
#include "core/mill/map/level_curves.hpp"

namespace sculpt {

/// One spacing apart at most over the surface, all as far as a patch goes; the first and the last half of that from the
/// outermost balls, from which the patch goes on by its reach. `along_u`: straight ones would lie along u, else along
/// v.
std::vector<Curve> parallel_curves(const PlanPatch& patch, double reach_m, double spacing_m, bool along_u);

}  // namespace sculpt
