// What the rules for jobs need of a database: the rows of jobs, and what hangs on them. One implementation for each
// kind of database; the rules (job_table.hpp and what stands on it) are the same for all.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/store/job_record.hpp"

namespace sculpt::server {

/// A job with the number of its row.
struct JobRow {
  std::int64_t number = 0;
  JobRecord job;
};

/// Call inside a transaction, from one thread at a time. All throw StorageError.
class JobRows {
 public:
  virtual ~JobRows() = default;
  virtual std::optional<JobRow> find(const std::string& id) = 0;
  /// A new row, as the job is submitted; gives it as it is read from now on.
  virtual JobRow insert(const JobRecord& job) = 0;
  /// Writes what changes in a job's life, if the row is still in the state `from` under `attempt`; false: it is not.
  virtual bool update(const JobRow& row, JobState from, int attempt) = 0;
  /// The job's next event, which says that it has come to `state`. `data` is the JSON of it.
  virtual void add_event(const JobRow& row, JobState state, const std::string& time, const std::string& data) = 0;
  virtual void add_artifacts(const JobRow& row, const std::vector<StoredArtifact>& artifacts) = 0;
  virtual void forget_artifacts(const JobRow& row) = 0;
  /// With its events and artifacts; of the job stays that there was one.
  virtual void erase(const JobRow& row) = 0;
};

}  // namespace sculpt::server
