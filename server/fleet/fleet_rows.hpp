// Rows of the table of jobs in PostgreSQL <-> records, and what hangs on them: events, artifacts, leases.
#pragma once

#include <chrono>

#include "server/fleet/postgres_change.hpp"
#include "server/store/job_rows.hpp"

namespace sculpt::server {

/// Of the files of a job's last attempt, among those of all jobs: each has its own, so that a run that lost its job,
/// and does not know yet, writes where nobody reads.
std::string attempt_folder(const JobRecord& job);

/// A row of an answer that begins with job_columns (job_columns.hpp). Throws StorageError for a state that nobody
/// knows.
JobRow read_fleet_row(const Answered& answer, int row);

/// Of one transaction. Rows that it changes were locked when they were found, so they are as they were read, and the
/// change goes with the commit.
class FleetRows : public JobRows {
 public:
  struct Lease {
    std::string daemon;
    std::chrono::milliseconds time;
  };
  FleetRows(PostgresChange& change, const Lease& lease) : change_(change), lease_(lease) {}

  std::optional<JobRow> find(const std::string& id) override;
  /// `rest` is what stands behind FROM sculptd.job.
  std::vector<JobRow> select(const std::string& rest, const std::vector<SqlValue>& values);
  static Question selection(const std::string& rest, const std::vector<SqlValue>& values);
  static std::vector<JobRow> rows_of(const Answered& answer);

  JobRow insert(const JobRecord& job) override;
  bool update(const JobRow& row, JobState from, int attempt) override;
  void add_event(const JobRow& row, JobState state, const std::string& time, const std::string& data) override;
  void add_artifacts(const JobRow& row, const std::vector<StoredArtifact>& artifacts) override;
  void forget_artifacts(const JobRow& row) override;
  void erase(const JobRow& row) override;

 private:
  PostgresChange& change_;
  const Lease& lease_;
};

}  // namespace sculpt::server
