// The questions to the store, on a connection of their own that only reads: they see what is committed and wait for no
// writer.
#pragma once

#include <mutex>

#include "server/store/job_store.hpp"
#include "server/store/sqlite/sqlite.hpp"

namespace sculpt::server {

/// Safe from any thread.
class StoreReader : public JobReader {
 public:
  /// The database must be up to date and outlive this.
  explicit StoreReader(Database& database) : database_(database) {}

  std::optional<JobRecord> find(const std::string& id) override;
  std::optional<JobRecord> find_key(const std::string& key) override;
  bool was_removed(const std::string& id) override;
  JobPage list(const JobWindow& window) override;
  bool queue_paused() override;
  std::uint64_t queue_age_s() override;
  std::vector<StateEvent> events(const std::string& job, std::uint64_t after, int limit) override;
  std::uint64_t last_event(const std::string& job) override;
  std::vector<StoredArtifact> artifacts(const std::string& id) override;

 private:
  std::mutex mutex_;
  Database& database_;
};

}  // namespace sculpt::server
