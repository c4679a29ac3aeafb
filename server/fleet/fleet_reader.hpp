// The questions to the store of a fleet, on a connection of their own: they see what is committed and wait for no
// writer.
#pragma once

#include <mutex>

#include "server/fleet/fleet_member.hpp"
#include "server/fleet/postgres.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

/// Safe from any thread; the methods are those of JobStore.
class FleetReader {
 public:
  /// The database must have today's tables.
  explicit FleetReader(const PostgresSource& source);

  std::string epoch();
  std::optional<JobRecord> find(const std::string& id);
  std::optional<JobRecord> find_key(const std::string& key);
  bool was_removed(const std::string& id);
  JobPage list(const JobWindow& window);
  bool queue_paused();
  std::uint64_t queue_age_s();
  std::vector<StateEvent> events(const std::string& job, std::uint64_t after, int limit);
  std::uint64_t last_event(const std::string& job);
  std::vector<StoredArtifact> artifacts(const std::string& id);
  /// Those that were heard of in the last hour.
  std::vector<FleetDaemon> daemons();

 private:
  Answered ask(const Question& question);

  std::mutex mutex_;
  Postgres database_;
};

/// Of the files of a job's present run, among those of all jobs: each attempt has its own, so that a run that lost its
/// job, and does not know yet, writes where nobody reads.
std::string attempt_folder(const JobRecord& job);

}  // namespace sculpt::server
