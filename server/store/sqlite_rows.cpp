#include "server/store/sqlite_rows.hpp"

namespace sculpt::server {
namespace {

constexpr const char* columns =
    "number, id, state, key, priority, not_before, start_by, max_runtime_s, spec, cell_bundle, memory_bytes, rank, "
    "attempt, failures, crashes, isolated, wake_at, submitted_at, started_at, finished_at, error_code, error_sentence, "
    "pinned, owner, inherited";

Statement query(Database& database, const std::string& rest, const std::vector<std::string>& values) {
  Statement statement(database, std::string("SELECT ") + columns + " FROM job WHERE " + rest);
  for (const std::string& value : values) statement.bind(value);
  return statement;
}

JobState read_state(const std::string& job, const std::string& word) {
  const std::optional<JobState> state = find_state(word);
  if (!state) throw StorageError("job " + job + " has the unknown state '" + word + "' in the database");
  return *state;
}

JobRow read_row(const Statement& row) {
  JobRow read;
  JobRecord& job = read.job;
  int column = 0;
  const auto text = [&] { return row.text(column++); };
  const auto number = [&] { return row.number(column++); };
  const auto small = [&] { return static_cast<int>(row.number(column++)); };
  read.number = number();
  job.id = text();
  job.state = read_state(job.id, text());
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
  job.isolated = number() != 0;
  job.wake_at = text();
  job.submitted_at = text();
  job.started_at = text();
  job.finished_at = text();
  job.error_code = text();
  job.error_sentence = text();
  job.pinned = number() != 0;
  job.owner = text();
  job.inherited = text();
  job.folder = job.id;
  return read;
}

constexpr int id_column = 1;

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
  return *find(job.id);
}

bool SqliteRows::update(const JobRow& row, JobState from, int attempt) {
  const JobRecord& job = row.job;
  Statement update(database_,
                   "UPDATE job SET state=?, attempt=?, failures=?, crashes=?, isolated=?, wake_at=?, started_at=?, "
                   "finished_at=?, error_code=?, error_sentence=? WHERE number=? AND state=? AND attempt=?");
  update.bind(name(job.state)).bind(job.attempt).bind(job.failures).bind(job.crashes).bind(job.isolated ? 1 : 0);
  update.bind(job.wake_at).bind(job.started_at).bind(job.finished_at).bind(job.error_code).bind(job.error_sentence);
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
