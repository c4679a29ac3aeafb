#include "server/fleet/fleet_rows.hpp"

#include "server/base/storage_error.hpp"

namespace sculpt::server {

const char* const job_columns =
    "job.number, job.id, job.state, job.key, job.priority, job.not_before, job.start_by, job.max_runtime_s, job.spec, "
    "job.cell_bundle, job.memory_bytes, job.rank, job.attempt, job.failures, job.crashes, job.isolated, job.wake_at, "
    "job.submitted_at, job.started_at, job.finished_at, job.error_code, job.error_sentence, job.pinned, job.owner, "
    "job.inherited";

JobRow read_job_row(const Answered& answer, int row) {
  JobRow read;
  JobRecord& job = read.job;
  int column = 0;
  const auto text = [&] { return answer.text(row, column++); };
  const auto number = [&] { return answer.number(row, column++); };
  const auto small = [&] { return static_cast<int>(answer.number(row, column++)); };
  const auto flag = [&] { return answer.flag(row, column++); };
  read.number = number();
  job.id = text();
  const std::string state = text();
  if (!find_state(state))
    throw StorageError("job " + job.id + " has the unknown state '" + state + "' in the database");
  job.state = *find_state(state);
  job.key = text();
  job.schedule.priority = small();
  job.schedule.not_before = text();
  job.schedule.start_by = text();
  job.schedule.max_runtime_s = number();
  job.spec = text();
  job.cell_bundle = text();
  job.memory_bytes = static_cast<std::uint64_t>(number());
  job.rank = number();
  job.attempt = small();
  job.failures = small();
  job.crashes = small();
  job.isolated = flag();
  job.wake_at = text();
  job.submitted_at = text();
  job.started_at = text();
  job.finished_at = text();
  job.error_code = text();
  job.error_sentence = text();
  job.pinned = flag();
  job.owner = text();
  job.inherited = text();
  return read;
}

Question FleetRows::selection(const std::string& rest, const std::vector<SqlValue>& values) {
  return {std::string("SELECT ") + job_columns + " FROM sculptd.job " + rest, values};
}

std::vector<JobRow> FleetRows::rows_of(const Answered& answer) {
  std::vector<JobRow> rows;
  for (int row = 0; row < answer.rows(); ++row) rows.push_back(read_job_row(answer, row));
  return rows;
}

std::vector<JobRow> FleetRows::select(const std::string& rest, const std::vector<SqlValue>& values) {
  return rows_of(change_.ask(selection(rest, values)));
}

std::optional<JobRow> FleetRows::find(const std::string& id) {
  std::vector<JobRow> rows = select("WHERE id=$1 FOR UPDATE", {sql_value(id)});
  return rows.empty() ? std::nullopt : std::optional(std::move(rows.front()));
}

JobRow FleetRows::insert(const JobRecord& job) {
  const SqlValue key = job.key.empty() ? std::nullopt : sql_value(job.key);
  const Answered answer = change_.ask(
      {std::string("INSERT INTO sculptd.job(id, state, key, priority, not_before, start_by, max_runtime_s, spec, "
                   "cell_bundle, memory_bytes, rank, wake_at, submitted_at, owner, inherited) "
                   "VALUES($1,$2,$3,$4,$5,$6,$7,$8,$9,$10,$11,$12,$13,$14,$15) RETURNING ") +
           job_columns,
       {sql_value(job.id), sql_value(std::string(name(job.state))), key, sql_value(job.schedule.priority),
        sql_value(job.schedule.not_before), sql_value(job.schedule.start_by), sql_value(job.schedule.max_runtime_s),
        sql_value(job.spec), sql_value(job.cell_bundle), sql_value(static_cast<std::int64_t>(job.memory_bytes)),
        sql_value(job.rank), sql_value(job.wake_at), sql_value(job.submitted_at), sql_value(job.owner),
        sql_value(job.inherited)}});
  return read_job_row(answer, 0);
}

bool FleetRows::update(const JobRow& row, JobState from, int attempt) {
  const JobRecord& job = row.job;
  const SqlValue number = sql_value(row.number);
  change_.later(
      {"UPDATE sculptd.job SET state=$1, attempt=$2, failures=$3, crashes=$4, isolated=$5, wake_at=$6, started_at=$7, "
       "finished_at=$8, error_code=$9, error_sentence=$10 WHERE number=$11 AND state=$12 AND attempt=$13",
       {sql_value(std::string(name(job.state))), sql_value(job.attempt), sql_value(job.failures),
        sql_value(job.crashes), sql_flag(job.isolated), sql_value(job.wake_at), sql_value(job.started_at),
        sql_value(job.finished_at), sql_value(job.error_code), sql_value(job.error_sentence), number,
        sql_value(std::string(name(from))), sql_value(attempt)}});
  if (is_active(job.state) && !is_active(from)) {
    change_.later(
        {"INSERT INTO sculptd.lease(job, daemon, attempt, until) "
         "VALUES($1, $2, $3, now() + $4 * interval '1 ms')",
         {number, sql_value(lease_.daemon), sql_value(job.attempt), sql_value(lease_.time.count())}});
  } else if (is_active(from) && !is_active(job.state)) {
    change_.later({"DELETE FROM sculptd.lease WHERE job=$1", {number}});
  }
  return true;
}

void FleetRows::add_event(const JobRow& row, JobState state, const std::string& time, const std::string& data) {
  change_.lock_events_later();
  change_.later(
      {"INSERT INTO sculptd.event(number, job, seq, time, state, data) "
       "SELECT nextval('sculptd.event_number'), $1, coalesce(max(seq), 0) + 1, $2, $3, $4 "
       "FROM sculptd.event WHERE job=$1 RETURNING number",
       {sql_value(row.number), sql_value(time), sql_value(std::string(name(state))), sql_value(data)}});
}

void FleetRows::add_artifacts(const JobRow& row, const std::vector<StoredArtifact>& artifacts) {
  std::int64_t place = 0;
  for (const StoredArtifact& artifact : artifacts)
    change_.later({"INSERT INTO sculptd.artifact VALUES($1, $2, $3, $4, $5, $6)",
                   {sql_value(row.number), sql_value(place++), sql_value(artifact.artifact), sql_value(artifact.format),
                    sql_value(static_cast<std::int64_t>(artifact.size)), sql_value(artifact.sha256)}});
}

void FleetRows::forget_artifacts(const JobRow& row) {
  change_.later({"DELETE FROM sculptd.artifact WHERE job=$1", {sql_value(row.number)}});
}

void FleetRows::erase(const JobRow& row) {
  const SqlValue number = sql_value(row.number);
  change_.lock_events_later();
  change_.later(
      {"INSERT INTO sculptd.removed(id, state, first_event, last_event) SELECT $1, $2, min(number), "
       "greatest((SELECT max(number) FROM sculptd.event), (SELECT max(last_event) FROM sculptd.removed)) "
       "FROM sculptd.event WHERE job=$3",
       {sql_value(row.job.id), sql_value(std::string(name(row.job.state))), number}});
  for (const char* sql : {"DELETE FROM sculptd.event WHERE job=$1", "DELETE FROM sculptd.artifact WHERE job=$1",
                          "DELETE FROM sculptd.job WHERE number=$1"})
    change_.later({sql, {number}});
}

}  // namespace sculpt::server
