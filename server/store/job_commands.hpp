// How a client's command changes its job. Call inside a transaction.
#pragma once

#include "server/store/job_store.hpp"
#include "server/store/job_table.hpp"

namespace sculpt::server {

/// The error of a job that has ended and of whose files one is not what was stored.
inline constexpr const char* damage_code = "artifact_damaged";

/// Throws ProtocolError `queue_full` and `quota` for one more job than there may be (StoreRules).
void refuse_too_many(const JobTally& tally, const StoreRules& rules, const std::string& owner);

/// Throws ProtocolError `queue_unknown` where nobody serves the queue, for whoever mistyped it.
void refuse_unserved(const std::string& queue, const std::vector<std::string>& served);

/// Throws ProtocolError `not_found`.
[[noreturn]] void refuse_unknown(const std::string& id);

/// The job of this key was submitted before. Throws ProtocolError `key_conflict` if it was another one.
Submitted repeat_submit(const JobRecord& first, const NewJob& wanted);
/// A job as it is submitted at `now_ms`, with the rank that it has by its priority when ranks count from `rank_ms`.
JobRecord make_job(const NewJob& wanted, const std::string& id, std::uint64_t now_ms, std::int64_t rank_ms,
                   const StoreRules& rules);

// What each does: JobStore. They throw ProtocolError `wrong_state`.
void cancel_job(JobTable& jobs, JobRow& row);
void pause_job(JobTable& jobs, JobRow& row);
void resume_job(JobTable& jobs, JobRow& row);
void retry_job(JobTable& jobs, const StoreRules& rules, JobRow& row);

}  // namespace sculpt::server
