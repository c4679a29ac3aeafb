// A job as clients see it (proto/PROTOCOL.md, job.get).
#pragma once

#include <chrono>

#include "proto/json.hpp"
#include "server/queue/scheduler.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

/// What a view shows beside the record. Any thread.
struct ViewSources {
  JobStore& store;
  const Scheduler& scheduler;
  std::chrono::milliseconds keep;  ///< Config::keep
};

/// With progress while it runs and its position while it is queued. Throws StorageError for a damaged spec.
Json job_view(const ViewSources& sources, const JobRecord& job);
/// `{stage, done, total}`; `loose_keep` and `keep` where some of the target hangs on nothing, `ambiguous` and
/// `ambiguous_at_mm` where the mesh does not say for sure what is inside.
Json progress_view(const Progress& progress);
/// `{code, message}` of a job's last failure.
Json error_view(const JobRecord& job);

}  // namespace sculpt::server
