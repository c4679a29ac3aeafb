// A job with milling tools, from mesh bytes to verified trajectory.
#pragma once

#include "core/plan/checkpoint/checkpoint_folder.hpp"
#include "core/plan/job.hpp"
#include "core/plan/job_result.hpp"
#include "core/plan/output/output.hpp"

namespace sculpt {

/// As run_job, of a job whose search is `mill`; goes on where `kept` has a checkpoint. Throws also InputError
/// `tools_invalid` for a tool that cannot be used in the cell, or for wishes of the surface that cannot be kept.
JobResult plan_milled(const Job& job, const OutputPlace& place, const Watch& watch, CheckpointFolder kept);

}  // namespace sculpt
