// A daemon of a fleet: what it says of itself to the others, and what it wants to be told.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/watch.hpp"
#include "server/store/job_record.hpp"
#include "server/store/job_state.hpp"

namespace sculpt::server {

/// Of this daemon.
struct FleetMember {
  std::string id;  ///< its own for ever; another daemon has another
  int workers = 0;
  std::uint64_t memory_bytes = 0;                  ///< of the jobs that it runs at once; 0: no bound
  std::vector<std::string> queues{default_queue};  ///< whose jobs it plans
};

/// What this daemon runs.
struct AtWork {
  int jobs = 0;
  std::uint64_t memory_bytes = 0;
  bool suspect = false;  ///< one of them is suspected of crashes
};

/// Another daemon, or this one, as the database knows it.
struct FleetDaemon {
  std::string id, address, version;
  int workers = 0, running = 0;
  std::uint64_t memory_bytes = 0;
  std::vector<std::string> queues;
  double silent_s = 0;  ///< since it was heard of last
};

/// None may throw. They are called on threads of the store.
struct FleetHooks {
  std::function<void(const std::string& job, JobState to)> changed;  ///< by another daemon
  std::function<void(const std::string& job)> lost;                  ///< the run is no longer ours: end it
  std::function<std::optional<Progress>(const std::string& job)> progress;
};

/// What tells of trouble in the database before it is felt.
struct DatabaseFigures {
  double oldest_transaction_s = 0;  ///< of all that the role may see; while it lasts no dead row can be swept
  std::uint64_t dead_rows = 0;      ///< of the table of jobs
};

}  // namespace sculpt::server
