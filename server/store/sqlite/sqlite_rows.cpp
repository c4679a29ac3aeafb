#include "server/store/sqlite/sqlite_rows.hpp"

#include "server/store/job_columns.hpp"

namespace sculpt::server {
namespace {

Statement query(Database& database, const std::string& rest, const std::vector<std::string>& values) {
  Statement statement(database, std::string("SELECT ") + job_columns + " FROM job WHERE " + rest);
  for (const std::string& value : values) statement.bind(value);
  return statement;
}

JobRow read_row(const Statement& row) {
  JobRow read = read_job_row(row);
  read.job.folder = read.job.id;
  return read;
}

}  // namespace

std::vector<JobRow> select_jobs(Database& database, const std::string& rest, const std::vector<std::string>& values) {
  Statement statement = query(database, rest, values);
  std::vector<JobRow> rows;
  while (statement.step()) rows.push_back(read_row(statement));
  return rows;
}

std::optional<JobRow> select_job(Database& database, const std::string& rest, const std::vector<std::string>& values) {
  std::vector<JobRow> rows = select_jobs(database, rest + " LIMIT 1", values);
  return rows.empty() ? std::nullopt : std::optional(std::move(rows.front()));
}

JobPage select_page(Database& database, const std::string& rest, const std::vector<std::string>& values, int limit) {
  Statement statement = query(database, rest, values);
  JobPage page;
  while (statement.step()) {
    if (page.jobs.size() == static_cast<std::size_t>(limit)) {
      page.more = true;
      break;
    }
    try {
      page.jobs.push_back(read_row(statement).job);
    } catch (const StorageError& error) {
      page.damaged.push_back({statement.text(id_column), error.what()});
    }
  }
  return page;
}

JobRow SqliteRows::insert(const JobRecord& job) {
  Statement insert(database_, std::string("INSERT INTO job(") + submitted_columns +
                                  ") VALUES(nullif(?, ''),?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  add_submitted(job, [&insert](const auto& value) { insert.bind(value); });
  insert.run();
  return *find(job.id);
}

bool SqliteRows::update(const JobRow& row, JobState from, int attempt) {
  Statement update(database_, std::string("UPDATE job SET (") + changing_columns +
                                  ")=(?,?,?,?,?,?,?,?,?,?) WHERE number=? AND state=? AND attempt=?");
  add_changing(row.job, [&update](const auto& value) { update.bind(value); });
  return update.bind(row.number).bind(name(from)).bind(attempt).run() == 1;
}

void SqliteRows::add_event(const JobRow& row, JobState state, const std::string& time, const std::string& data) {
  Statement insert(database_,
                   "INSERT INTO event(job, seq, time, state, data) "
                   "SELECT ?1, coalesce(max(seq), 0) + 1, ?2, ?3, ?4 FROM event WHERE job = ?1");
  insert.bind(row.number).bind(time).bind(name(state)).bind(data).run();
  count_change();
}

void SqliteRows::add_artifacts(const JobRow& row, const std::vector<StoredArtifact>& artifacts) {
  std::int64_t place = 0;
  for (const StoredArtifact& artifact : artifacts) {
    Statement insert(database_, "INSERT INTO artifact VALUES(?,?,?,?,?,?)");
    insert.bind(row.number).bind(place++).bind(artifact.artifact).bind(artifact.format);
    insert.bind(static_cast<std::int64_t>(artifact.size)).bind(artifact.sha256).run();
  }
}

void SqliteRows::forget_artifacts(const JobRow& row) {
  Statement(database_, "DELETE FROM artifact WHERE job=?").bind(row.number).run();
}

void SqliteRows::erase(const JobRow& row) {
  for (const char* sql :
       {"DELETE FROM event WHERE job=?", "DELETE FROM artifact WHERE job=?", "DELETE FROM job WHERE number=?"}) {
    Statement(database_, sql).bind(row.number).run();
  }
  Statement(database_, "INSERT INTO removed VALUES(?)").bind(row.job.id).run();
  count_change();
}

void SqliteRows::count_change() {
  Statement(database_, "INSERT INTO meta VALUES('changes', '1') ON CONFLICT(name) DO UPDATE SET value=value+1").run();
}

std::uint64_t SqliteRows::changes() {
  Statement query(database_, "SELECT value FROM meta WHERE name='changes'");
  return query.step() ? static_cast<std::uint64_t>(query.number(0)) : 0;
}

}  // namespace sculpt::server
