// Finishing with one ball cutter: until no point of the surface that it comes to stands above the tolerance.
#pragma once

#include "core/mill/carver.hpp"
#include "core/mill/finish/part_views.hpp"

namespace sculpt {

/// With the tool that `carver` holds. `is_last`: no other tool comes after it; else spots that are too small to be
/// worth a way there are left to that. Throws InputError, Cancelled.
void finish(const MillJob& job, PartViews& views, Carver& carver, bool is_last, const RunContext& run);

}  // namespace sculpt
