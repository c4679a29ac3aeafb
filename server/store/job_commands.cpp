#include "server/store/job_commands.hpp"

#include <algorithm>

#include "proto/error_codes.hpp"

namespace sculpt::server {
namespace {

using enum JobState;

[[noreturn]] void refuse(const JobRecord& job, const std::string& what) {
  throw proto::ProtocolError("wrong_state", "job " + job.id + " is " + name(job.state) + " and cannot be " + what);
}

}  // namespace

void refuse_unknown(const std::string& id) {
  throw proto::ProtocolError("not_found", "there is no job '" + id + "'", "/params/job");
}

void refuse_too_many(const JobTally& tally, const StoreRules& rules, const std::string& owner) {
  if (tally.open() >= static_cast<std::uint64_t>(rules.max_jobs)) {
    throw proto::ProtocolError("queue_full",
                               "the server has " + std::to_string(rules.max_jobs) +
                                   " jobs that have not ended, as many as it may: try again when some have, or "
                                   "raise max_jobs");
  }
  if (!owner.empty() && tally.open(owner) >= static_cast<std::uint64_t>(rules.max_jobs_per_owner)) {
    throw proto::ProtocolError("quota",
                               "'" + owner + "' has " + std::to_string(rules.max_jobs_per_owner) +
                                   " jobs that have not ended, as many as one may: try again when some have, or "
                                   "raise max_jobs_per_owner");
  }
}

void refuse_unserved(const std::string& queue, const std::vector<std::string>& served) {
  if (std::ranges::find(served, queue) != served.end()) return;
  std::string names;
  for (const std::string& name : served) names += (names.empty() ? "" : ", ") + name;
  throw proto::ProtocolError("queue_unknown",
                             "no daemon serves the queue '" + queue + "': there is " +
                                 (names.empty() ? "none that is served" : names) +
                                 "; name one of those, or start a daemon that has '" + queue + "' among its queues",
                             "/params/queue");
}

Submitted repeat_submit(const JobRecord& first, const NewJob& wanted) {
  if (first.spec == wanted.spec) return {first, true};
  throw proto::ProtocolError("key_conflict",
                             "the key '" + wanted.key + "' belongs to job " + first.id +
                                 ", which has another spec: use a new key for a new job",
                             "/params/key");
}

JobRecord make_job(const NewJob& wanted, const std::string& id, std::uint64_t now_ms, std::int64_t rank_ms,
                   const StoreRules& rules) {
  JobRecord job;
  job.id = id;
  job.key = wanted.key;
  job.owner = wanted.owner;
  job.schedule = wanted.schedule;
  job.spec = wanted.spec;
  job.cell_bundle = wanted.cell_bundle;
  job.inherited = wanted.inherited;
  job.memory_bytes = wanted.memory_bytes;
  job.rank = rank_ms - static_cast<std::int64_t>(rules.ageing_ms) * wanted.schedule.priority;
  job.submitted_at = utc_text(now_ms);
  if (wanted.schedule.not_before > job.submitted_at) {
    job.state = held;
    job.wake_at = wanted.schedule.not_before;
  }
  return job;
}

void cancel_job(JobTable& jobs, JobRow& row) {
  const JobState state = row.job.state;
  if (state == cancelled || state == cancelling) return;
  if (is_final(state)) refuse(row.job, "cancelled any more");
  jobs.move(row, is_active(state) ? cancelling : cancelled, "cancel_requested");
}

void pause_job(JobTable& jobs, JobRow& row) {
  const JobState state = row.job.state;
  if (state == paused || state == pausing) return;
  if (is_final(state) || state == cancelling) refuse(row.job, "paused");
  jobs.move(row, state == running ? pausing : paused, "pause_requested");
}

void resume_job(JobTable& jobs, JobRow& row) {
  JobRecord& job = row.job;
  if (is_final(job.state) || job.state == cancelling) refuse(job, "resumed");
  if (job.state == pausing) refuse(job, "resumed before it is paused: try again in a moment");
  if (job.state != paused) return;
  const bool early = job.schedule.not_before > jobs.now();
  if (early) job.wake_at = job.schedule.not_before;
  jobs.move(row, early ? held : queued, "resumed");
}

void retry_job(JobTable& jobs, const StoreRules& rules, JobRow& row) {
  JobRecord& job = row.job;
  const bool damaged = job.error_code == damage_code;
  if (job.state != quarantined && !damaged)
    refuse(job, "retried: only quarantined jobs are, and those with a damaged artifact");
  job.crashes = damaged ? 0 : std::max(1, rules.max_crashes - 1);
  job.failures = 0;
  job.error_code.clear();
  job.error_sentence.clear();
  jobs.forget_artifacts(row);
  jobs.move(row, queued, "retried");
}

}  // namespace sculpt::server
