// One run of a stored job: spec and blobs -> planner -> artifacts on disk.
#pragma once

#include "server/planner.hpp"
#include "server/scheduler.hpp"
#include "server/translate.hpp"

namespace sculpt {

/// The spec as it was stored. Throws StorageError when the database gave back something else.
JobSpec read_stored_spec(const JobRecord& job);

/// Runs a job in this process. Everything is durable when it returns; when it throws InputError, the job's files are
/// gone, else they stay for the next attempt. Refers to planner and blobs.
RunJob make_run_job(const Planner& planner, const Blobs& blobs, const std::filesystem::path& jobs,
                    const JobDefaults& defaults);

}  // namespace sculpt
