#include "server/store/job_row.hpp"

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

}  // namespace sculpt::server
