// Finishing with one ball cutter: until no point of the surface that it comes to stands above the tolerance.
#pragma once

#include "core/mill/carver.hpp"
#include "core/mill/finish/part_views.hpp"

namespace sculpt {

/// With the tool that `carver` holds. `next`: the ball cutter that finishes after it, if there is one; what that does
/// on a shorter way is left to it. Throws InputError, Cancelled.
void finish(const MillJob& job, PartViews& views, Carver& carver, const MillTool* next, const RunContext& run);

}  // namespace sculpt
