#include "server/store/job_table.hpp"

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
  Statement insert(database_,
                   "INSERT INTO job(id, state, key, priority, not_before, start_by, max_runtime_s, spec, cell_bundle, "
                   "memory_bytes, rank, wake_at, submitted_at, owner, inherited) "
                   "VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  insert.bind(job.id).bind(name(job.state));
  job.key.empty() ? insert.bind_null() : insert.bind(job.key);
  insert.bind(job.schedule.priority).bind(job.schedule.not_before).bind(job.schedule.start_by);
  insert.bind(job.schedule.max_runtime_s).bind(job.spec).bind(job.cell_bundle);
  insert.bind(static_cast<std::int64_t>(job.memory_bytes)).bind(job.rank).bind(job.wake_at).bind(job.submitted_at);
  insert.bind(job.owner).bind(job.inherited).run();
  JobRow row = *find(job.id);
  Json data{{"to", name(job.state)}, {"reason", "submitted"}};
  describe(job, data);
  add_event(row, std::move(data));
  moves_.push_back({job.rank, job.id, job.owner, std::nullopt, job.state});
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
  Statement update(database_,
                   "UPDATE job SET state=?, attempt=?, failures=?, crashes=?, isolated=?, wake_at=?, started_at=?, "
                   "finished_at=?, error_code=?, error_sentence=? WHERE number=? AND state=? AND attempt=?");
  update.bind(name(to)).bind(job.attempt).bind(job.failures).bind(job.crashes).bind(job.isolated ? 1 : 0);
  update.bind(job.wake_at).bind(job.started_at).bind(job.finished_at).bind(job.error_code).bind(job.error_sentence);
  update.bind(row.number).bind(name(from)).bind(attempt);
  if (update.run() != 1) throw StorageError("job " + job.id + " changed under the hands of the store");
  job.state = to;
  Json data{{"from", name(from)}, {"to", name(to)}, {"reason", reason}};
  describe(job, data);
  add_event(row, std::move(data));
  moves_.push_back({job.rank, job.id, job.owner, from, to});
}

void JobTable::add_artifacts(const JobRow& row, const std::vector<StoredArtifact>& artifacts) {
  std::int64_t place = 0;
  for (const StoredArtifact& artifact : artifacts) {
    Statement insert(database_, "INSERT INTO artifact VALUES(?,?,?,?,?,?)");
    insert.bind(row.number).bind(place++).bind(artifact.artifact).bind(artifact.format);
    insert.bind(static_cast<std::int64_t>(artifact.size)).bind(artifact.sha256).run();
  }
}

void JobTable::forget_artifacts(const JobRow& row) {
  Statement(database_, "DELETE FROM artifact WHERE job=?").bind(row.number).run();
}

void JobTable::erase(const JobRow& row) {
  for (const char* sql :
       {"DELETE FROM event WHERE job=?", "DELETE FROM artifact WHERE job=?", "DELETE FROM job WHERE number=?"}) {
    Statement(database_, sql).bind(row.number).run();
  }
  Statement(database_, "INSERT INTO removed VALUES(?)").bind(row.job.id).run();
  count_change();
  moves_.push_back({row.job.rank, row.job.id, row.job.owner, row.job.state, std::nullopt});
}

void JobTable::add_event(const JobRow& row, Json data) {
  Statement insert(database_,
                   "INSERT INTO event(job, seq, time, state, data) "
                   "SELECT ?1, coalesce(max(seq), 0) + 1, ?2, ?3, ?4 FROM event WHERE job = ?1");
  insert.bind(row.number).bind(now()).bind(name(row.job.state)).bind(proto::write_json(data)).run();
  count_change();
}

void JobTable::count_change() {
  Statement(database_, "INSERT INTO meta VALUES('changes', '1') ON CONFLICT(name) DO UPDATE SET value=value+1").run();
}

std::uint64_t JobTable::changes() {
  Statement query(database_, "SELECT value FROM meta WHERE name='changes'");
  return query.step() ? static_cast<std::uint64_t>(query.number(0)) : 0;
}

}  // namespace sculpt::server
