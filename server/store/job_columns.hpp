// The columns of the table of jobs, the same in each kind of database: how a row becomes a record, and a record a row.
#pragma once

#include <string>

#include "server/base/storage_error.hpp"
#include "server/store/job_rows.hpp"

namespace sculpt::server {

/// What is read of a job, in the order of read_job_row.
inline constexpr const char* job_columns =
    "job.number, job.id, job.state, job.key, job.priority, job.not_before, job.start_by, job.max_runtime_s, job.spec, "
    "job.cell_bundle, job.memory_bytes, job.rank, job.attempt, job.failures, job.crashes, job.isolated, job.wake_at, "
    "job.submitted_at, job.started_at, job.finished_at, job.error_code, job.error_sentence, job.pinned, job.owner, "
    "job.inherited, job.queue";
inline constexpr int id_column = 1;

/// Of a row that begins with these columns and tells them by text(COLUMN), number(COLUMN) and flag(COLUMN). The folder
/// is left to the caller. Throws StorageError for a state that nobody knows.
template <typename Row>
JobRow read_job_row(const Row& row) {
  JobRow read;
  JobRecord& job = read.job;
  int column = 0;
  const auto text = [&] { return row.text(column++); };
  const auto number = [&] { return row.number(column++); };
  const auto small = [&] { return static_cast<int>(row.number(column++)); };
  const auto flag = [&] { return row.flag(column++); };
  read.number = number();
  job.id = text();
  const std::string state = text();
  const std::optional<JobState> known = find_state(state);
  if (!known) throw StorageError("job " + job.id + " has the unknown state '" + state + "' in the database");
  job.state = *known;
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
  job.schedule.queue = text();
  return read;
}

/// What a submitted job has; the key comes first, so that an empty one can become none.
inline constexpr const char* submitted_columns =
    "key, id, state, priority, not_before, start_by, max_runtime_s, spec, cell_bundle, memory_bytes, rank, wake_at, "
    "submitted_at, owner, inherited, queue";

/// Calls `add` with each of their values: a text or an integer.
template <typename Add>
void add_submitted(const JobRecord& job, Add add) {
  add(job.key);
  add(job.id);
  add(std::string(name(job.state)));
  add(job.schedule.priority);
  add(job.schedule.not_before);
  add(job.schedule.start_by);
  add(job.schedule.max_runtime_s);
  add(job.spec);
  add(job.cell_bundle);
  add(static_cast<std::int64_t>(job.memory_bytes));
  add(job.rank);
  add(job.wake_at);
  add(job.submitted_at);
  add(job.owner);
  add(job.inherited);
  add(job.schedule.queue);
}

/// What changes in its life.
inline constexpr const char* changing_columns =
    "state, attempt, failures, crashes, isolated, wake_at, started_at, finished_at, error_code, error_sentence";

/// As add_submitted.
template <typename Add>
void add_changing(const JobRecord& job, Add add) {
  add(std::string(name(job.state)));
  add(job.attempt);
  add(job.failures);
  add(job.crashes);
  add(job.isolated ? 1 : 0);
  add(job.wake_at);
  add(job.started_at);
  add(job.finished_at);
  add(job.error_code);
  add(job.error_sentence);
}

}  // namespace sculpt::server
