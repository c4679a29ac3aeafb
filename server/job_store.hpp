// What must never be lost: jobs, their events, and what is known of their artifacts. One small interface, so that
// another engine can fill it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "server/histogram.hpp"
#include "server/job_state.hpp"

namespace sculpt {

/// The disk or the database failed; nothing was acknowledged.
class StorageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct NewJob {
  std::string key;  ///< empty: none
  int priority = 0;
  std::string spec;         ///< JobSpec as canonical JSON
  std::string cell_bundle;  ///< hash of the bundle that was valid when the job was submitted
};

struct JobRecord {
  std::string id;
  JobState state = JobState::queued;
  std::string key;
  int priority = 0;
  std::string spec;
  std::string cell_bundle;
  int attempt = 0;  ///< how often it was claimed; also the fence: a worker's writes count only under its own number
  std::string submitted_at, started_at, finished_at;
  std::string error_code, error_sentence;
};

struct Submitted {
  JobRecord job;
  bool duplicate = false;
};

/// A durable event; `data` is the JSON of its `data` field. `seq` starts at 1 and has no gaps.
struct StateEvent {
  std::uint64_t seq = 0;
  std::string time;
  std::string data;
  JobState to = JobState::queued;
};

struct StoredArtifact {
  std::string artifact, format;
  std::uint64_t size = 0;
  std::string sha256;
};

/// How a run ended: succeeded or failed.
struct Ending {
  JobState state = JobState::failed;
  std::string error_code, error_sentence;
  std::vector<StoredArtifact> artifacts;
};

/// Safe from any thread. A change is on disk when its call returns; with it, in the same transaction, is its event.
/// Every method throws StorageError.
class JobStore {
 public:
  virtual ~JobStore() = default;
  /// Names this store for ever; another data folder has another.
  virtual std::string epoch() = 0;

  /// The same key and spec give the first job again. Throws ProtocolError `key_conflict` for the same key with another
  /// spec.
  virtual Submitted submit(const NewJob& job) = 0;
  /// queued -> running of the best queued job: highest priority, then first submitted.
  virtual std::optional<JobRecord> claim() = 0;
  /// running -> succeeded or failed; cancelling -> cancelled. False when this attempt does not own the job any more:
  /// the result must be dropped.
  virtual bool finish(const std::string& job, int attempt, const Ending& ending) = 0;
  /// The run stopped before its end: running -> queued (interrupted), cancelling -> cancelled. False as for finish.
  virtual bool release(const std::string& job, int attempt) = 0;
  /// queued -> cancelled, running -> cancelling; cancelling and cancelled stay. Throws ProtocolError `not_found` or
  /// `wrong_state`.
  virtual JobState cancel(const std::string& job) = 0;
  /// Call once before any worker starts: what a killed daemon left running is released. Returns how many.
  virtual int recover() = 0;

  virtual std::optional<JobRecord> find(const std::string& job) = 0;
  virtual std::optional<JobRecord> find_key(const std::string& key) = 0;
  /// In the order of submission, behind `after` (empty: from the first).
  virtual std::vector<JobRecord> list(const std::string& after, int limit) = 0;
  virtual std::map<JobState, std::uint64_t> counts() = 0;
  /// How long ago the oldest queued job was submitted, by wall time; 0 if none is queued.
  virtual std::uint64_t queue_age_s() = 0;
  /// How long the commits took since the start; does not throw.
  virtual const Histogram& commit_times() = 0;
  /// How many queued jobs will be claimed before this one.
  virtual std::uint64_t position(const JobRecord& job) = 0;
  /// Events behind `after`, in order.
  virtual std::vector<StateEvent> events(const std::string& job, std::uint64_t after, int limit) = 0;
  virtual std::uint64_t last_event(const std::string& job) = 0;
  virtual std::vector<StoredArtifact> artifacts(const std::string& job) = 0;
};

/// Throws StorageError (unreadable, no database, made by a newer version).
std::unique_ptr<JobStore> open_sqlite_store(const std::filesystem::path& file);

}  // namespace sculpt
