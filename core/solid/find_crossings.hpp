// Surface -> Crossings, one axis at a time.
#pragma once

#include "core/base/watch.hpp"
#include "core/solid/crossings.hpp"
#include "core/solid/shells.hpp"

namespace sculpt {

/// Throws InputError `mesh_not_solid` where facets lie in each other by the ten thousand; Cancelled.
Crossings find_crossings(const Surface& surface, int n, int axis, const Watch& watch);

}  // namespace sculpt
