// One run of a stored job: spec and blobs -> planner -> artifacts on disk.
#pragma once

#include "server/artifacts.hpp"
#include "server/scheduler.hpp"
#include "server/translate.hpp"

namespace sculpt {

/// The spec as it was stored. Throws StorageError when the database gave back something else.
JobSpec read_stored_spec(const JobRecord& job);

/// What the scheduler calls. Everything is durable when it returns. When it throws Cancelled, trajectory and
/// checkpoints are kept for the next run; when it throws anything else, the job's files are gone. Refers to its
/// arguments.
RunJob make_run_job(const Planner& planner, const Blobs& blobs, const Artifacts& artifacts,
                    const JobDefaults& defaults);

}  // namespace sculpt
