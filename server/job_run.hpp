// One run of a stored job: spec and blobs -> planner -> artifacts on disk.
#pragma once

#include "server/planner.hpp"
#include "server/scheduler.hpp"
#include "server/translate.hpp"

namespace sculpt {

/// The spec as it was stored. Throws StorageError when the database gave back something else.
JobSpec read_stored_spec(const JobRecord& job);

/// Runs a job in this process, from its last checkpoint on. Everything is durable when it returns; when it throws,
/// trajectory and checkpoints are left for the next run. Refers to planner and blobs.
RunJob make_run_job(const Planner& planner, const Blobs& blobs, const std::filesystem::path& jobs,
                    const JobDefaults& defaults);

}  // namespace sculpt
