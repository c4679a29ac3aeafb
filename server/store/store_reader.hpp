// The questions to the store, on a connection of their own that only reads: they see what is committed and wait for no
// writer.
#pragma once

#include <mutex>

#include "server/store/job_store.hpp"
#include "server/store/sqlite.hpp"

namespace sculpt::server {

/// Safe from any thread; the methods are those of JobStore.
class StoreReader {
 public:
  /// The database must be up to date and outlive this.
  explicit StoreReader(Database& database) : database_(database) {}

  std::optional<JobRecord> find(const std::string& id);
  std::optional<JobRecord> find_key(const std::string& key);
  bool was_removed(const std::string& id);
  JobPage list(const JobWindow& window);
  bool queue_paused();
  std::uint64_t queue_age_s();
  std::vector<StateEvent> events(const std::string& job, std::uint64_t after, int limit);
  std::uint64_t last_event(const std::string& job);
  std::vector<StoredArtifact> artifacts(const std::string& id);

 private:
  std::mutex mutex_;
  Database& database_;
};

}  // namespace sculpt::server
