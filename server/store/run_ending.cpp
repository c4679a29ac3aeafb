#include "server/store/run_ending.hpp"

namespace sculpt::server {
namespace {

using enum JobState;

// A run inside the daemon has ended and the daemon lives.
void acquit(JobRecord& job) {
  if (!job.isolated) job.crashes = 0;
}

// A failure that is not the job's own: another try, later and in a process of its own after a crash, or no more.
void end_badly(JobTable& jobs, const StoreRules& rules, JobRow& row, Cause cause) {
  JobRecord& job = row.job;
  const bool crash = cause == Cause::crash;
  const int tries = crash ? ++job.crashes : ++job.failures;
  if (tries >= (crash ? rules.max_crashes : rules.max_failures)) {
    return jobs.move(row, crash ? quarantined : failed, crash ? "crashed" : "finished");
  }
  if (job.state == pausing) return jobs.move(row, paused, crash ? "crashed" : "failed");
  job.wake_at = utc_text(jobs.now_ms() + (rules.first_backoff_ms << (tries - 1)));
  jobs.move(row, backoff, crash ? "crashed" : "failed");
}

}  // namespace

void start_run(JobTable& jobs, const StoreRules& rules, JobRow& row) {
  JobRecord& job = row.job;
  job.isolated = rules.isolate || job.crashes > 0;
  if (!job.isolated) ++job.crashes;  // taken back when the run ends while the daemon lives
  job.error_code.clear();
  job.error_sentence.clear();
  jobs.move(row, running, "claimed");
}

void expire_job(JobTable& jobs, JobRow& row) {
  row.job.error_code = "expired";
  row.job.error_sentence = "it could not start by " + row.job.schedule.start_by + ": submit it again with more time";
  jobs.move(row, expired, "start_by_passed");
}

void end_run(JobTable& jobs, const StoreRules& rules, JobRow& row, const Ending& ending) {
  JobRecord& job = row.job;
  acquit(job);
  if (job.state == cancelling) return jobs.move(row, cancelled, "finished");
  job.error_code = ending.error_code;
  job.error_sentence = ending.error_sentence;
  if (ending.state == succeeded) job.crashes = job.failures = 0;
  if (ending.state == failed && ending.cause != Cause::job) return end_badly(jobs, rules, row, ending.cause);
  jobs.move(row, ending.state, "finished");
  jobs.add_artifacts(row, ending.artifacts);
}

void stop_run(JobTable& jobs, JobRow& row) {
  acquit(row.job);
  abandon_run(jobs, row);
}

void abandon_run(JobTable& jobs, JobRow& row) {
  switch (row.job.state) {
    case cancelling:
      return jobs.move(row, cancelled, "finished");
    case pausing:
      return jobs.move(row, paused, "interrupted");
    default:
      return jobs.move(row, queued, "interrupted");
  }
}

}  // namespace sculpt::server
