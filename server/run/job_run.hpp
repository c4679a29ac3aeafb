// One run of a stored job: spec and blobs -> planner -> artifacts on disk.
#pragma once

#include <set>
#include <string>

#include "server/run/planner.hpp"
#include "server/run/run_outcome.hpp"
#include "server/run/translate.hpp"

namespace sculpt::server {

/// The spec as it was stored. Throws StorageError when the database gave back something else.
proto::JobSpec read_stored_spec(const JobRecord& job);

/// The uploads that a job is planned from. A cell bundle that is in `bundles` is taken as known, and is not read again.
std::set<std::string> blobs_of(const JobRecord& job, const Blobs& blobs, std::set<std::string>& bundles);

/// All of them are in the folder of blobs when this returns: for a process that reads them by their paths.
void fetch_blobs(const JobRecord& job, const Blobs& blobs);

/// Runs a job in this process, from its last checkpoint on, in a folder that is there. Everything is durable when it
/// returns; when it throws, trajectory and checkpoints are left for the next run.
Ending run_in_folder(const JobRecord& record, const Job& job, const std::filesystem::path& folder,
                     const Planner& planner, const Watch& watch);

/// The same of a job as it is stored. Refers to planner and blobs.
RunJob make_run_job(const Planner& planner, const Blobs& blobs, const std::filesystem::path& jobs,
                    const JobDefaults& defaults);

}  // namespace sculpt::server
