// Rows of the table of jobs in SQLite <-> records.
#pragma once

#include "server/store/job_rows.hpp"
#include "server/store/job_store.hpp"
#include "server/store/sqlite/sqlite.hpp"

namespace sculpt::server {

/// `rest` is what stands behind WHERE, with a ? for each value. Throws StorageError, also for a damaged row.
std::vector<JobRow> select_jobs(Database& database, const std::string& rest, const std::vector<std::string>& values);
std::optional<JobRow> select_job(Database& database, const std::string& rest, const std::vector<std::string>& values);

/// The same, with damaged rows set aside; ends behind `limit` good ones, and `more` says whether another row follows.
JobPage select_page(Database& database, const std::string& rest, const std::vector<std::string>& values, int limit);

class SqliteRows : public JobRows {
 public:
  explicit SqliteRows(Database& database) : database_(database) {}

  std::optional<JobRow> find(const std::string& id) override { return first("id=?", {id}); }
  std::optional<JobRow> first(const std::string& rest, const std::vector<std::string>& values) {
    return select_job(database_, rest, values);
  }
  std::vector<JobRow> all(const std::string& rest, const std::vector<std::string>& values) {
    return select_jobs(database_, rest, values);
  }

  JobRow insert(const JobRecord& job) override;
  bool update(const JobRow& row, JobState from, int attempt) override;
  void add_event(const JobRow& row, JobState state, const std::string& time, const std::string& data) override;
  void add_artifacts(const JobRow& row, const std::vector<StoredArtifact>& artifacts) override;
  void forget_artifacts(const JobRow& row) override;
  void erase(const JobRow& row) override;

  /// Every event and every removal of a job is a change: so a store that lost one knows fewer than it had.
  std::uint64_t changes();

 private:
  void count_change();

  Database& database_;
};

}  // namespace sculpt::server
