// What happened in the store, whoever of the fleet did it: followed by the numbers of the events, in order. From it
// come the counts of jobs, and the news for those who wait on this daemon.
#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "server/fleet/postgres.hpp"
#include "server/store/job_state.hpp"
#include "server/store/job_tally.hpp"

namespace sculpt::server {

/// A job that another daemon has changed.
struct FleetNews {
  std::string job;
  JobState to = JobState::queued;
};

/// Safe from any thread.
class FleetFeed {
 public:
  /// Counts all jobs as they are now.
  void start(Postgres& database);
  /// Reads what is new, and counts it. Throws StorageError: then nothing of it is counted yet.
  void read(Postgres& database);
  /// The same for who asks himself, in another's trip.
  std::vector<Question> questions() const;
  /// True: there may be more.
  bool take(const Answered& events, const Answered& removals);
  /// Events that this daemon made itself: they are counted, and no news.
  void made_here(const std::vector<std::uint64_t>& numbers);
  /// What others did, since the last call.
  std::vector<FleetNews> take_news();

  const JobTally& tally() const { return tally_; }
  /// The jobs that are known to be in a daemon's hands, as PostgreSQL writes an array. Who asks for their leases by
  /// name does not pass those of all jobs since somebody opened a transaction: while it is open, they stay.
  SqlValue at_work() const;

 private:
  struct OpenJob {
    std::int64_t rank = 0;
    std::string owner, queue;
    JobState state = JobState::queued;
  };
  void count_event(const Answered& events, int row);
  void count_removal(const Answered& removed, int row);
  void keep(const std::string& id, const OpenJob& job);
  void count(const std::string& id, const OpenJob& now, std::optional<JobState> known);

  mutable std::mutex mutex_;
  JobTally tally_;
  std::map<std::string, OpenJob> open_;
  std::set<std::string> at_work_;  // of those
  std::int64_t last_event_ = 0, last_removed_ = 0;
  std::set<std::uint64_t> own_;
  std::vector<FleetNews> news_;
};

}  // namespace sculpt::server
