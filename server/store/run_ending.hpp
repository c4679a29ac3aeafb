// How the start and the end of a run, and time, change its job. Call inside a transaction.
#pragma once

#include "server/store/job_store.hpp"
#include "server/store/job_table.hpp"

namespace sculpt::server {

/// A worker takes the queued job.
void start_run(JobTable& jobs, const StoreRules& rules, JobRow& row);
/// The job has never started, and should have by now.
void expire_job(JobTable& jobs, JobRow& row);
/// The run of a job in a state that is_active has ended as it says, and its process lives.
void end_run(JobTable& jobs, const StoreRules& rules, JobRow& row, const Ending& ending);
/// The same for a run that was stopped before its end.
void stop_run(JobTable& jobs, JobRow& row);
/// The same for one that a killed daemon left: nobody knows how it ended.
void abandon_run(JobTable& jobs, JobRow& row);

}  // namespace sculpt::server
