#include "server/job_table.hpp"

namespace sculpt {
namespace {

constexpr const char* columns =
    "number, id, state, key, priority, not_before, start_by, max_runtime_s, spec, cell_bundle, memory_bytes, rank, "
    "attempt, failures, crashes, isolated, wake_at, submitted_at, started_at, finished_at, error_code, error_sentence, "
    "pinned, owner";

JobRow read_row(const Statement& row) {
  JobRow read;
  JobRecord& job = read.job;
  int column = 0;
  const auto text = [&] { return row.text(column++); };
  const auto number = [&] { return row.number(column++); };
  const auto small = [&] { return static_cast<int>(row.number(column++)); };
  read.number = number();
  job.id = text();
  const std::string word = text();
  const std::optional<JobState> state = find_state(word);
  if (!state) throw StorageError("job " + job.id + " has the unknown state '" + word + "' in the database");
  job.state = *state;
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
  return read;
}

// What the event of a change says besides from, to and reason.
void describe(const JobRecord& job, Json& data) {
  if (job.attempt > 0) data["attempt"] = job.attempt;
  if (!job.wake_at.empty()) data["until"] = job.wake_at;
  if (!job.error_code.empty()) data["error"] = {{"code", job.error_code}, {"message", job.error_sentence}};
}

}  // namespace

std::optional<JobRow> JobTable::first(const std::string& rest, const std::vector<std::string>& values) {
  std::vector<JobRow> rows = all(rest + " LIMIT 1", values);
  return rows.empty() ? std::nullopt : std::optional(std::move(rows.front()));
}

std::vector<JobRow> JobTable::all(const std::string& rest, const std::vector<std::string>& values) {
  Statement query(database_, std::string("SELECT ") + columns + " FROM job WHERE " + rest);
  for (const std::string& value : values) query.bind(value);
  std::vector<JobRow> rows;
  while (query.step()) rows.push_back(read_row(query));
  return rows;
}

JobRow JobTable::insert(const JobRecord& job) {
  Statement insert(database_,
                   "INSERT INTO job(id, state, key, priority, not_before, start_by, max_runtime_s, spec, cell_bundle, "
                   "memory_bytes, rank, wake_at, submitted_at, owner) VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
  insert.bind(job.id).bind(name(job.state));
  job.key.empty() ? insert.bind_null() : insert.bind(job.key);
  insert.bind(job.schedule.priority).bind(job.schedule.not_before).bind(job.schedule.start_by);
  insert.bind(job.schedule.max_runtime_s).bind(job.spec).bind(job.cell_bundle);
  insert.bind(static_cast<std::int64_t>(job.memory_bytes)).bind(job.rank).bind(job.wake_at).bind(job.submitted_at);
  insert.bind(job.owner).run();
  JobRow row = *find(job.id);
  Json data{{"to", name(job.state)}, {"reason", "submitted"}};
  describe(job, data);
  add_event(row, std::move(data));
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
}

void JobTable::add_event(const JobRow& row, Json data) {
  Statement insert(database_,
                   "INSERT INTO event(job, seq, time, state, data) "
                   "SELECT ?1, coalesce(max(seq), 0) + 1, ?2, ?3, ?4 FROM event WHERE job = ?1");
  insert.bind(row.number).bind(now()).bind(name(row.job.state)).bind(write_json(data)).run();
  count_change();
}

void JobTable::count_change() {
  Statement(database_, "INSERT INTO meta VALUES('changes', '1') ON CONFLICT(name) DO UPDATE SET value=value+1").run();
}

std::uint64_t JobTable::changes() {
  Statement query(database_, "SELECT value FROM meta WHERE name='changes'");
  return query.step() ? static_cast<std::uint64_t>(query.number(0)) : 0;
}

}  // namespace sculpt
