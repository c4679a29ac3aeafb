// What a plan with milling tools leaves of the surface, as a file.
#pragma once

#include <iosfwd>

#include "core/base/watch.hpp"
#include "core/plan/job.hpp"

namespace sculpt {

/// The surface as machined, as a binary .ply: vertices in metres in the stock's frame, each where what stands above the
/// part's surface ends, with `excess_m`, how much that is along the outward normal, and a colour for it: green as far
/// as the job's tolerance, over yellow to red at ten times that. `plan`: the trajectory of `job`. Throws InputError
/// `trajectory_invalid`, and those of files that are no shape; Cancelled.
void write_machined_surface(const Job& job, std::istream& plan, std::ostream& ply, const Watch& watch);

}  // namespace sculpt
