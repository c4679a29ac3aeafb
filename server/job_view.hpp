// A job as clients see it (proto/PROTOCOL.md, job.get).
#pragma once

#include "server/services.hpp"

namespace sculpt {

/// With progress while it runs and its position while it is queued.
Json job_view(const Services& services, const JobRecord& job);
/// `{stage, done, total}`; `loose_keep` and `keep` where some of the target hangs on nothing, `ambiguous` and
/// `ambiguous_at_mm` where the mesh does not say for sure what is inside.
Json progress_view(const Progress& progress);
/// `{code, message}` of a job's last failure.
Json error_view(const JobRecord& job);

}  // namespace sculpt
