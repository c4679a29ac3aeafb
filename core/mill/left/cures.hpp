// What milling tools left -> why, and which tool would come to it.
#pragma once

#include <vector>

#include "core/base/run_context.hpp"
#include "core/material/voxel_set.hpp"
#include "core/mill/finish/part_views.hpp"
#include "core/mill/left/cure.hpp"
#include "core/mill/mill_job.hpp"

namespace sculpt {

/// The largest share first. Looked at is a part of what was `left` (of what was to be removed), evenly chosen: for each
/// voxel whether a ball can be in a dozen places about its centre, exactly against the part, and whether a body like
/// that of a tool of the job has room above it (to 2 mm). A ball of the job's own sizes is tried first, then thinner
/// ones with the body of the smallest. Any thread. Throws Cancelled.
std::vector<Cure> find_cures(const MillJob& job, const VoxelSet& left, PartViews& views, const RunContext& run);

}  // namespace sculpt
