// Rows around and around a surface, from its border inwards.
#pragma once

#include <vector>

#include "core/base/helpers.hpp"
#include "core/mill/finish/rows/plan_patch.hpp"
#include "core/mill/map/level_curves.hpp"

namespace sculpt {

/// The first so far from the border of a patch, each of the others one spacing from the one before it, over the
/// surface. Rings; where the patch is narrower than twice the first there are none.
std::vector<Curve> offset_curves(const PlanPatch& patch, double first_m, double spacing_m, const Helpers& helpers);

}  // namespace sculpt
