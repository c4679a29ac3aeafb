// What must never be lost: jobs, their events, and what is known of their artifacts. One small interface, so that
// another engine can fill it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>

#include "server/base/histogram.hpp"
#include "server/base/storage_error.hpp"
#include "server/base/time_stamp.hpp"
#include "server/store/job_record.hpp"
#include "server/store/job_state.hpp"

namespace sculpt::server {

struct Submitted {
  JobRecord job;
  bool duplicate = false;
};

/// A durable event; `data` is the JSON of its `data` field.
struct StateEvent {
  std::string job;
  std::uint64_t seq = 0;     ///< among those of the job, from 1 on, without gaps
  std::uint64_t number = 0;  ///< among those of all jobs: it rises, in the order in which they happened
  std::string time;
  std::string data;
  JobState to = JobState::queued;
};

/// Which jobs, in the order of submission or (`newest`) against it.
struct JobWindow {
  std::string after = {}, before = {};  ///< only those that were submitted between these two jobs; empty: no bound
  bool newest = false;
  int limit = 100;
};

/// A row that cannot be read.
struct DamagedJob {
  std::string id, why;
};

struct JobPage {
  std::vector<JobRecord> jobs;
  std::vector<DamagedJob> damaged;
  bool more = false;  ///< there are others in the window
};

/// What the store decides by.
struct StoreRules {
  std::function<std::uint64_t()> now_ms = {};  ///< wall time; empty: the store's own clock
  std::uint64_t ageing_ms = 60'000;  ///< a job overtakes those that wait so long already for each step of priority
  int max_failures = 3;              ///< a job that fails for the third time has failed, even if it could pass
  std::uint64_t first_backoff_ms = 10'000;  ///< doubled with each failure
  int max_crashes = 2;
  bool isolate = false;                            ///< every job runs in a process of its own, not only suspects
  std::uint64_t memory_bytes = 0;                  ///< predicted memory of the jobs that run at once; 0: no bound
  std::vector<std::string> queues{default_queue};  ///< whose jobs are claimed here
  int max_jobs = 100'000;                          ///< that have not ended
  int max_jobs_per_owner = 10'000;
  /// Told after each commit, on the thread that made it, how many changes of jobs there are (SqliteRows::changes).
  std::function<void(std::uint64_t changes)> committed = {};
};

/// The questions about jobs: they see what is committed, and wait for no change that is being written. Safe from any
/// thread. All throw StorageError.
class JobReader {
 public:
  virtual ~JobReader() = default;
  virtual bool queue_paused() = 0;
  /// There was such a job, and JobStore::remove took it.
  virtual bool was_removed(const std::string& job) = 0;
  virtual std::optional<JobRecord> find(const std::string& job) = 0;
  virtual std::optional<JobRecord> find_key(const std::string& key) = 0;
  virtual JobPage list(const JobWindow& window) = 0;
  /// How long ago the oldest queued job was submitted, by wall time; 0 if none is queued.
  virtual std::uint64_t queue_age_s() = 0;
  /// Events behind `after`, in order: of one job behind that seq, or (no job) of all behind that number.
  virtual std::vector<StateEvent> events(const std::string& job, std::uint64_t after, int limit) = 0;
  /// The seq of the job's last event, or (no job) the number of the last one that ever was; 0: none.
  virtual std::uint64_t last_event(const std::string& job) = 0;
  virtual std::vector<StoredArtifact> artifacts(const std::string& job) = 0;
};

/// Safe from any thread. A change is on disk when its call returns; with it, in the same transaction, is its event.
/// Every method throws StorageError, but for those that say so.
class JobStore {
 public:
  virtual ~JobStore() = default;
  /// Names this store for ever; another data folder has another.
  virtual std::string epoch() = 0;

  /// The same key and spec give the first job again. Throws ProtocolError `key_conflict` for the same key with another
  /// spec, `queue_unknown` for a queue that no daemon serves, `queue_full` and `quota` for a new job above max_jobs
  /// and, of an owner with a name, max_jobs_per_owner.
  virtual Submitted submit(const NewJob& job) = 0;
  /// queued -> running of the job that is next in StoreRules::queues: the one with the highest priority, where each
  /// step of priority is worth some waiting (StoreRules::ageing_ms). Nothing while the queue is paused, or while the
  /// next job has no room in the memory: none overtakes it. Suspects (jobs with crashes) run one at a time and are
  /// passed over meanwhile.
  virtual std::optional<JobRecord> claim() = 0;
  /// Running: succeeded or failed, or by the ending's cause backoff or quarantined; pausing: the same, but paused
  /// instead of backoff; cancelling: cancelled. False when this attempt does not own the job any more: the result must
  /// be dropped.
  virtual bool finish(const std::string& job, int attempt, const Ending& ending) = 0;
  /// The run stopped before its end, in order: running -> queued (interrupted), pausing -> paused, cancelling ->
  /// cancelled. False as for finish.
  virtual bool release(const std::string& job, int attempt) = 0;
  /// Call once before any worker starts: what a killed daemon left running is released, and is suspected if it ran
  /// inside the daemon. Returns how many.
  virtual int recover() = 0;
  /// Lets time pass: held and backoff -> queued when their time has come, held and queued -> expired when they should
  /// have started by now and never have. Gives the jobs that changed.
  virtual std::vector<std::string> wake_due() = 0;

  // Each gives the state that the job has now. They throw ProtocolError `not_found` or `wrong_state`.
  /// Running and pausing -> cancelling, final ones are `wrong_state`, all others -> cancelled; repeating it is fine.
  virtual JobState cancel(const std::string& job) = 0;
  /// Held, queued and backoff -> paused, running -> pausing; repeating it is fine.
  virtual JobState pause(const std::string& job) = 0;
  /// Paused -> queued, or held when its time has not come. Fine for a job that is not paused and has not ended.
  virtual JobState resume(const std::string& job) = 0;
  /// Quarantined -> queued, with its crashes forgotten but for one: it runs in a process of its own. The same of a job
  /// with noted damage: its artifacts are forgotten and planned again.
  virtual JobState retry(const std::string& job) = 0;

  /// While the queue is paused nothing is claimed, also after a restart.
  virtual void set_queue_paused(bool paused) = 0;

  /// Keeps a job for ever, or not any more. Throws ProtocolError `not_found`.
  virtual void pin(const std::string& job, bool pinned) = 0;
  /// Forgets a final job that is not pinned, with its events and artifacts; its key is free again. False if it is none.
  virtual bool remove(const std::string& job) = 0;
  /// A file of a job that has ended with artifacts is not what was stored: from now on the job says so, as its error
  /// `artifact_damaged`. Nothing for any other job.
  virtual void note_damage(const std::string& job, const std::string& sentence) = 0;

  // These are kept counted: they read nothing and do not throw.
  virtual std::map<JobState, std::uint64_t> counts() = 0;
  /// How many queued jobs of its queue will be claimed before this one.
  virtual std::uint64_t position(const JobRecord& job) = 0;
  /// How long the commits took since the start.
  virtual const Histogram& commit_times() = 0;

  // What JobReader says.
  bool queue_paused() { return reader().queue_paused(); }
  bool was_removed(const std::string& job) { return reader().was_removed(job); }
  std::optional<JobRecord> find(const std::string& job) { return reader().find(job); }
  std::optional<JobRecord> find_key(const std::string& key) { return reader().find_key(key); }
  JobPage list(const JobWindow& window) { return reader().list(window); }
  std::uint64_t queue_age_s() { return reader().queue_age_s(); }
  std::vector<StateEvent> events(const std::string& job, std::uint64_t after, int limit) {
    return reader().events(job, after, limit);
  }
  std::uint64_t last_event(const std::string& job) { return reader().last_event(job); }
  std::vector<StoredArtifact> artifacts(const std::string& job) { return reader().artifacts(job); }

 protected:
  virtual JobReader& reader() = 0;
};

/// Throws ProtocolError `not_found`, or `gone` for one that was removed, with the pointer of what names it.
JobRecord find_job(JobStore& store, const std::string& job, const std::string& pointer = "/params/job");

/// Throws StorageError (unreadable, no database, made by a newer version).
std::unique_ptr<JobStore> open_sqlite_store(const std::filesystem::path& file, StoreRules rules = {});

}  // namespace sculpt::server
