// What the job store should do, over a plain vector: the property tests play the same moves on both. Knows nothing of
// SQL, rows or ranks; times are milliseconds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/store/job_store.hpp"

namespace sculpt::server {

struct ModelJob {
  std::string id;
  JobState state = JobState::queued;
  int priority = 0;
  std::uint64_t submitted_ms = 0, not_before_ms = 0, start_by_ms = 0, wake_ms = 0;  // 0: none
  std::uint64_t memory_bytes = 0;
  int attempt = 0, failures = 0, crashes = 0;
  bool isolated = false, pinned = false;
  std::string owner, queue;
};

/// Refused moves give nothing.
class StoreModel {
 public:
  StoreModel(const StoreRules& rules, const std::uint64_t& now_ms) : rules_(rules), now_ms_(now_ms) {}

  /// The code of the error with which a submit is refused now, or empty.
  std::string refusal_of(const std::string& owner, const std::string& queue) const;
  void submit(const std::string& id, const NewJob& wanted, std::uint64_t not_before_ms, std::uint64_t start_by_ms);
  std::optional<std::string> claim();
  bool finish(const std::string& id, int attempt, const Ending& ending);
  bool release(const std::string& id, int attempt);
  int recover();
  std::vector<std::string> wake_due();
  std::optional<JobState> cancel(const std::string& id);
  std::optional<JobState> pause(const std::string& id);
  std::optional<JobState> resume(const std::string& id);
  std::optional<JobState> retry(const std::string& id);
  void pin(const std::string& id, bool pinned) { at(id).pinned = pinned; }
  bool remove(const std::string& id);
  bool queue_paused = false;

  const std::vector<ModelJob>& jobs() const { return jobs_; }
  std::uint64_t position(const ModelJob& job) const;

 private:
  ModelJob& at(const std::string& id);
  ModelJob* owned(const std::string& id, int attempt);
  bool comes_before(const ModelJob& a, const ModelJob& b) const;
  bool is_late(const ModelJob& job) const;
  bool is_served(const std::string& queue) const;
  void interrupt(ModelJob& job);
  void fail(ModelJob& job, Cause cause);

  const StoreRules& rules_;
  const std::uint64_t& now_ms_;
  std::vector<ModelJob> jobs_;  // in the order of submission
};

}  // namespace sculpt::server
