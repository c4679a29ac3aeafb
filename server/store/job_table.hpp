// The rows of jobs and their events in SQLite: the one place where a job's state changes. Call inside a transaction.
#pragma once

#include "proto/json.hpp"
#include "server/store/job_row.hpp"
#include "server/store/job_tally.hpp"

namespace sculpt::server {

class JobTable {
 public:
  JobTable(Database& database, const StoreRules& rules) : database_(database), rules_(rules) {}

  std::optional<JobRow> find(const std::string& id) { return first("id=?", {id}); }
  std::optional<JobRow> find_key(const std::string& key) { return first("key=?", {key}); }
  std::optional<JobRow> first(const std::string& rest, const std::vector<std::string>& values) {
    return select_job(database_, rest, values);
  }
  std::vector<JobRow> all(const std::string& rest, const std::vector<std::string>& values) {
    return select_jobs(database_, rest, values);
  }

  /// A new row with its first event.
  JobRow insert(const JobRecord& job);
  /// Writes the row as it stands, in its new state, with the event that says so. Throws StorageError when the row is
  /// not as it was read, std::logic_error when the table of moves (job_state.cpp) does not have this one.
  void move(JobRow& row, JobState to, const char* reason);
  void add_artifacts(const JobRow& row, const std::vector<StoredArtifact>& artifacts);
  void forget_artifacts(const JobRow& row);
  /// With its events and artifacts; of the job stays that there was one.
  void erase(const JobRow& row);

  /// What was done since the last call: to be counted once it is committed, or forgotten.
  std::vector<TallyMove> take_moves() { return std::exchange(moves_, {}); }

  /// Every event and every removal of a job is a change: so a store that lost one knows fewer than it had.
  void count_change();
  std::uint64_t changes();

  std::string now() const { return utc_text(rules_.now_ms()); }

 private:
  void add_event(const JobRow& row, Json data);

  Database& database_;
  const StoreRules& rules_;
  std::vector<TallyMove> moves_;
};

}  // namespace sculpt::server
