// What milling tools left -> why, and which tool would come to it.
#pragma once

#include <string>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/material/voxel_set.hpp"
#include "core/mill/finish/part_views.hpp"
#include "core/mill/mill_job.hpp"

namespace sculpt {

/// What kept the tools of a job from a place.
enum class Obstacle {
  way,     ///< one of them would come to it: the arm did not, or it was too little to be worth a pass
  length,  ///< one is thin enough, but what is above its cutter is in the way: it is too short
  radius,  ///< only a thinner cutter comes there
  side     ///< none, along none of the directions
};

/// "way", "length", "radius", "side".
const char* name(Obstacle obstacle);

/// A ball cutter that would come to a part of what was left.
struct Cure {
  Obstacle obstacle = Obstacle::side;
  double diameter_m = 0;  ///< of the cutter; 0 where none comes there
  double free_m = 0;      ///< from its tip to what is thicker than the cutter, in whole millimetres; 0 if no matter
  double share = 0;       ///< of what was left

  /// "D4 with 62 mm free would reach it".
  std::string sentence() const;
};

/// The largest share first. Looked at is a part of what was `left` (of what was to be removed), evenly chosen: for each
/// voxel whether a ball can be in a dozen places about its centre, exactly against the part, and whether a body like
/// that of a tool of the job has room above it (to 2 mm). A ball of the job's own sizes is tried first, then thinner
/// ones with the body of the smallest. Any thread. Throws Cancelled.
std::vector<Cure> find_cures(const MillJob& job, const VoxelSet& left, PartViews& views, const RunContext& run);

}  // namespace sculpt
