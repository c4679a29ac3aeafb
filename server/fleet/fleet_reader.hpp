// The questions to the store of a fleet, on a connection of their own: they see what is committed and wait for no
// writer.
#pragma once

#include <mutex>

#include "server/fleet/fleet_member.hpp"
#include "server/fleet/postgres.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

/// Safe from any thread.
class FleetReader : public JobReader {
 public:
  /// The database must have today's tables.
  explicit FleetReader(const PostgresSource& source);

  std::string epoch();
  std::optional<JobRecord> find(const std::string& id) override;
  std::optional<JobRecord> find_key(const std::string& key) override;
  bool was_removed(const std::string& id) override;
  JobPage list(const JobWindow& window) override;
  bool queue_paused() override;
  std::uint64_t queue_age_s() override;
  std::vector<StateEvent> events(const std::string& job, std::uint64_t after, int limit) override;
  std::uint64_t last_event(const std::string& job) override;
  std::vector<StoredArtifact> artifacts(const std::string& id) override;
  /// Those that were heard of in the last hour.
  std::vector<FleetDaemon> daemons();

 private:
  Answered ask(const Question& question);

  std::mutex mutex_;
  Postgres database_;
};

}  // namespace sculpt::server
