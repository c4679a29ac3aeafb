// The jobs of a store and their events: the one place where a job's state changes. Call inside a transaction.
#pragma once

#include <functional>
#include <utility>

#include "proto/json.hpp"
#include "server/base/time_stamp.hpp"
#include "server/store/job_rows.hpp"
#include "server/store/job_tally.hpp"

namespace sculpt::server {

class JobTable {
 public:
  /// `now_ms`: wall time, the same for all daemons that share the rows.
  JobTable(JobRows& rows, std::function<std::uint64_t()> now_ms) : rows_(rows), now_ms_(std::move(now_ms)) {}

  std::optional<JobRow> find(const std::string& id) { return rows_.find(id); }

  /// A new row with its first event.
  JobRow insert(const JobRecord& job);
  /// Writes the row as it stands, in its new state, with the event that says so. Throws StorageError when the row is
  /// not as it was read, std::logic_error when the table of moves (job_state.cpp) does not have this one.
  void move(JobRow& row, JobState to, const char* reason);
  void add_artifacts(const JobRow& row, const std::vector<StoredArtifact>& artifacts) {
    rows_.add_artifacts(row, artifacts);
  }
  void forget_artifacts(const JobRow& row) { rows_.forget_artifacts(row); }
  /// With its events and artifacts; of the job stays that there was one.
  void erase(const JobRow& row);

  /// What was done since the last call: to be counted once it is committed, or forgotten.
  std::vector<TallyMove> take_moves() { return std::exchange(moves_, {}); }

  std::uint64_t now_ms() const { return now_ms_(); }
  std::string now() const { return utc_text(now_ms()); }

 private:
  JobRows& rows_;
  std::function<std::uint64_t()> now_ms_;
  std::vector<TallyMove> moves_;
};

}  // namespace sculpt::server
