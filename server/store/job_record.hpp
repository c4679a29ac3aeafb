// A job as the store keeps it, and how its runs end. Times are UTC text as in server/base/time_stamp.hpp, empty: none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/store/job_state.hpp"

namespace sculpt::server {

/// The queue of a job that names none, and the one that a daemon serves unless told otherwise.
inline constexpr const char* default_queue = "default";

/// What the client decides beside the spec.
struct Schedule {
  int priority = 0;
  std::string not_before;             ///< held until then
  std::string start_by;               ///< expired if it has never started by then
  std::int64_t max_runtime_s = 0;     ///< of one run; 0: no limit
  std::string queue = default_queue;  ///< only daemons that serve it claim the job
};

struct NewJob {
  std::string key;  ///< empty: none
  Schedule schedule;
  std::string spec;                ///< JobSpec as canonical JSON
  std::string cell_bundle;         ///< hash of the bundle that was valid when the job was submitted
  std::uint64_t memory_bytes = 0;  ///< predicted
  std::string owner{};             ///< who submits it; empty: nobody has a name
  std::string inherited{};         ///< from the job that it continues (inheritance.hpp); empty: it continues none
};

struct JobRecord {
  std::string id;
  JobState state = JobState::queued;
  std::string key;
  std::string owner;
  Schedule schedule;
  std::string spec;
  std::string cell_bundle;
  std::string inherited;
  std::uint64_t memory_bytes = 0;
  std::int64_t rank = 0;  ///< the lowest is next; see StoreRules::ageing_ms
  int attempt = 0;   ///< how often it was claimed; also the fence: a worker's writes count only under its own number
  int failures = 0;  ///< runs that ended with a fault that may pass
  int crashes =
      0;  ///< runs that took their process down, as far as is known; a run inside the daemon counts when it begins
  bool isolated = false;  ///< runs in a process of its own
  bool pinned = false;    ///< never removed
  std::string wake_at;    ///< while held or backoff: when it is queued
  std::string submitted_at, started_at, finished_at;
  std::string error_code, error_sentence;  ///< of its last failure
  std::string folder;                      ///< of its files, among those of all jobs
};

struct StoredArtifact {
  std::string artifact, format;
  std::uint64_t size = 0;
  std::string sha256;
};

/// Why a run failed.
enum class Cause {
  job,    ///< the job itself: another try would end the same
  fault,  ///< something around it, which may pass
  crash   ///< its process died
};

/// How a run ended: succeeded or failed.
struct Ending {
  JobState state = JobState::failed;
  std::string error_code, error_sentence;
  std::vector<StoredArtifact> artifacts;
  Cause cause = Cause::job;
};

}  // namespace sculpt::server
