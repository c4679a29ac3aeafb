// A job as clients see it (proto/PROTOCOL.md, job.get).
#pragma once

#include "server/services.hpp"

namespace sculpt {

/// What a view shows beside the record.
struct ViewSources {
  JobStore& store;
  const Scheduler& scheduler;
  std::chrono::milliseconds keep;  ///< Config::keep
};
/// Call on the I/O thread; the views may then be made on any.
ViewSources view_sources(const Services& services);

/// With progress while it runs and its position while it is queued. Throws StorageError for a damaged spec.
Json job_view(const ViewSources& sources, const JobRecord& job);
/// `{stage, done, total}`; `loose_keep` and `keep` where some of the target hangs on nothing, `ambiguous` and
/// `ambiguous_at_mm` where the mesh does not say for sure what is inside.
Json progress_view(const Progress& progress);
/// `{code, message}` of a job's last failure.
Json error_view(const JobRecord& job);

}  // namespace sculpt
