#include "server/fleet/fleet_rows.hpp"

#include "server/store/job_columns.hpp"

namespace sculpt::server {

namespace {

struct OneRow {
  const Answered& answer;
  int row;

  std::string text(int column) const { return answer.text(row, column); }
  std::int64_t number(int column) const { return answer.number(row, column); }
  bool flag(int column) const { return answer.flag(row, column); }
};

}  // namespace

std::string attempt_folder(const JobRecord& job) {
  return job.id + "/" + std::to_string(job.attempt);
}

JobRow read_fleet_row(const Answered& answer, int row) {
  JobRow read = read_job_row(OneRow{answer, row});
  read.job.folder = attempt_folder(read.job);
  return read;
}

Question FleetRows::selection(const std::string& rest, const std::vector<SqlValue>& values) {
  return {std::string("SELECT ") + job_columns + " FROM sculptd.job " + rest, values};
}

std::vector<JobRow> FleetRows::rows_of(const Answered& answer) {
  std::vector<JobRow> rows;
  for (int row = 0; row < answer.rows(); ++row) rows.push_back(read_fleet_row(answer, row));
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
  Question insert{std::string("INSERT INTO sculptd.job(") + submitted_columns +
                  ") VALUES(nullif($1, ''),$2,$3,$4,$5,$6,$7,$8,$9,$10,$11,$12,$13,$14,$15,$16) RETURNING " +
                  job_columns};
  add_submitted(job, [&insert](const auto& value) { insert.values.push_back(sql_value(value)); });
  return read_fleet_row(change_.ask(insert), 0);
}

bool FleetRows::update(const JobRow& row, JobState from, int attempt) {
  const JobRecord& job = row.job;
  const SqlValue number = sql_value(row.number);
  Question update{std::string("UPDATE sculptd.job SET (") + changing_columns +
                  ")=($1,$2,$3,$4,$5,$6,$7,$8,$9,$10) WHERE number=$11 AND state=$12 AND attempt=$13"};
  add_changing(job, [&update](const auto& value) { update.values.push_back(sql_value(value)); });
  update.values.insert(update.values.end(), {number, sql_value(std::string(name(from))), sql_value(attempt)});
  change_.later(std::move(update));
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
