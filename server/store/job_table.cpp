#include "server/store/job_table.hpp"

#include <stdexcept>

#include "server/base/storage_error.hpp"

namespace sculpt::server {
namespace {

// What the event of a change says besides from, to and reason.
void describe(const JobRecord& job, Json& data) {
  if (job.attempt > 0) data["attempt"] = job.attempt;
  if (!job.wake_at.empty()) data["until"] = job.wake_at;
  if (!job.error_code.empty()) data["error"] = {{"code", job.error_code}, {"message", job.error_sentence}};
}

}  // namespace

JobRow JobTable::insert(const JobRecord& job) {
  JobRow row = rows_.insert(job);
  Json data{{"to", name(job.state)}, {"reason", "submitted"}};
  describe(job, data);
  rows_.add_event(row, job.state, now(), proto::write_json(data));
  moves_.push_back({job.rank, job.id, job.owner, job.schedule.queue, std::nullopt, job.state});
  return row;
}

void JobTable::move(JobRow& row, JobState to, const char* reason) {
  JobRecord& job = row.job;
  const JobState from = job.state;
  if (!may_move(from, to)) {
    throw std::logic_error(std::string("job ") + job.id + " may not go from " + name(from) + " to " + name(to));
  }
  const int attempt = job.attempt;
  if (to == JobState::running) {
    job.started_at = now();
    ++job.attempt;
  }
  if (to != JobState::held && to != JobState::backoff) job.wake_at.clear();
  job.finished_at = is_final(to) ? now() : "";
  job.state = to;
  if (!rows_.update(row, from, attempt)) throw StorageError("job " + job.id + " changed under the hands of the store");
  Json data{{"from", name(from)}, {"to", name(to)}, {"reason", reason}};
  describe(job, data);
  rows_.add_event(row, to, now(), proto::write_json(data));
  moves_.push_back({job.rank, job.id, job.owner, job.schedule.queue, from, to});
}

void JobTable::erase(const JobRow& row) {
  rows_.erase(row);
  moves_.push_back({row.job.rank, row.job.id, row.job.owner, row.job.schedule.queue, row.job.state, std::nullopt});
}

}  // namespace sculpt::server
