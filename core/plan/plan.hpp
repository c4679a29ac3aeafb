// A job from mesh bytes to verified trajectory: the one place that sees all stages.
#pragma once

#include <chrono>
#include <filesystem>

#include "core/base/watch.hpp"
#include "core/plan/job.hpp"
#include "core/plan/job_result.hpp"
#include "core/trajectory/form.hpp"
#include "core/verify/verify.hpp"

namespace sculpt {

/// Plans, writing to `trajectory` what is final beside the planning, on a thread of its own (lines are flushed at least
/// once per block or layer), then verifies the written file. Before anything is planned `watch` is told how much of the
/// target hangs on nothing. Throws InputError (refused) or Cancelled; a plan with residue is a result, not an error.
/// Any thread; several jobs may run at once.
JobResult run_job(const Job& job, const std::filesystem::path& trajectory, const Watch& watch,
                  TrajectoryForm form = TrajectoryForm::text);

/// Replays a plan of the job, of either format, from its beginning (`in` can be read twice). Throws InputError
/// `trajectory_invalid` and those of files that are no shape; Cancelled.
Verdict replay_plan(std::istream& in, const Job& job, const Watch& watch, const ReplaySettings& settings);

/// Where a run keeps checkpoints and its timeline, and how old the last one is when the next is due, after the unit
/// then in work. At a stop it keeps what units had finished, whatever the time.
struct CheckpointPlace {
  std::filesystem::path folder;
  std::chrono::duration<double> interval = std::chrono::seconds(5);
  std::filesystem::path timeline = {};  ///< also written as it grows; empty: none
};

/// run_job in the text form that goes on where a run of the same job with the same place and trajectory file was
/// stopped or killed, at its last checkpoint, and gives what that one would have given: the same bytes, the same report
/// but for seconds, memory and threads. Where no checkpoint is whole and of this job and program, it starts over.
/// Checkpoints are left in the folder (remove_checkpoints). Throws as run_job.
JobResult resume_job(const Job& job, const std::filesystem::path& trajectory, const CheckpointPlace& place,
                     const Watch& watch);

}  // namespace sculpt
