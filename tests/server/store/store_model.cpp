#include "tests/server/store/store_model.hpp"

#include <algorithm>

namespace sculpt::server {

using enum JobState;

ModelJob& StoreModel::at(const std::string& id) {
  return *std::ranges::find(jobs_, id, &ModelJob::id);
}

ModelJob* StoreModel::owned(const std::string& id, int attempt) {
  ModelJob& job = at(id);
  return is_active(job.state) && job.attempt == attempt ? &job : nullptr;
}

// The defining property of ageing: each step of priority is worth ageing_ms of waiting.
bool StoreModel::comes_before(const ModelJob& a, const ModelJob& b) const {
  const auto lead = static_cast<std::int64_t>(rules_.ageing_ms) * (a.priority - b.priority);
  const auto later = static_cast<std::int64_t>(a.submitted_ms) - static_cast<std::int64_t>(b.submitted_ms);
  return lead != later ? lead > later : a.id < b.id;
}

bool StoreModel::is_late(const ModelJob& job) const {
  return job.start_by_ms != 0 && job.start_by_ms < now_ms_ && job.attempt == 0;
}

bool StoreModel::is_served(const std::string& queue) const {
  return std::ranges::find(rules_.queues, queue) != rules_.queues.end();
}

std::string StoreModel::refusal_of(const std::string& owner, const std::string& queue) const {
  if (!is_served(queue)) return "queue_unknown";
  int open = 0, own = 0;
  for (const ModelJob& job : jobs_) {
    if (is_final(job.state)) continue;
    ++open;
    own += job.owner == owner;
  }
  if (open >= rules_.max_jobs) return "queue_full";
  return !owner.empty() && own >= rules_.max_jobs_per_owner ? "quota" : "";
}

void StoreModel::submit(const std::string& id, const NewJob& wanted, std::uint64_t not_before_ms,
                        std::uint64_t start_by_ms) {
  ModelJob job;
  job.id = id;
  job.owner = wanted.owner;
  job.queue = wanted.schedule.queue;
  job.priority = wanted.schedule.priority;
  job.submitted_ms = now_ms_;
  job.not_before_ms = job.wake_ms = not_before_ms;
  job.start_by_ms = start_by_ms;
  job.memory_bytes = wanted.memory_bytes;
  job.state = not_before_ms > now_ms_ ? held : queued;
  jobs_.push_back(job);
}

std::optional<std::string> StoreModel::claim() {
  if (queue_paused) return std::nullopt;
  std::uint64_t taken = 0;
  bool idle = true, suspect_runs = false;
  for (const ModelJob& job : jobs_) {
    if (!is_active(job.state)) continue;
    idle = false;
    taken += job.memory_bytes;
    suspect_runs |= job.isolated && job.crashes > 0;
  }
  ModelJob* next = nullptr;
  for (ModelJob& job : jobs_) {
    if (job.state != queued || !is_served(job.queue) || is_late(job) || (job.crashes > 0 && suspect_runs)) continue;
    if (next == nullptr || comes_before(job, *next)) next = &job;
  }
  if (next == nullptr || (!idle && taken + next->memory_bytes > rules_.memory_bytes)) return std::nullopt;
  next->state = running;
  ++next->attempt;
  next->isolated = rules_.isolate || next->crashes > 0;
  if (!next->isolated) next->crashes = 1;
  return next->id;
}

bool StoreModel::finish(const std::string& id, int attempt, const Ending& ending) {
  ModelJob* job = owned(id, attempt);
  if (job == nullptr) return false;
  if (!job->isolated) job->crashes = 0;
  if (job->state == cancelling) {
    job->state = cancelled;
  } else if (ending.state == succeeded) {
    job->state = succeeded;
    job->crashes = job->failures = 0;
  } else {
    fail(*job, ending.cause);
  }
  return true;
}

void StoreModel::fail(ModelJob& job, Cause cause) {
  const JobState waiting = job.state == pausing ? paused : backoff;
  job.state = failed;
  std::uint64_t tries = 0;
  if (cause == Cause::fault) {
    if (++job.failures < rules_.max_failures) job.state = waiting;
    tries = static_cast<std::uint64_t>(job.failures);
  } else if (cause == Cause::crash) {
    job.state = ++job.crashes < rules_.max_crashes ? waiting : quarantined;
    tries = static_cast<std::uint64_t>(job.crashes);
  }
  job.wake_ms = now_ms_;
  std::uint64_t wait = rules_.first_backoff_ms;
  for (std::uint64_t i = 1; i < tries; ++i) wait *= 2;
  job.wake_ms += wait;
}

void StoreModel::interrupt(ModelJob& job) {
  job.state = job.state == cancelling ? cancelled : job.state == pausing ? paused : queued;
}

bool StoreModel::release(const std::string& id, int attempt) {
  ModelJob* job = owned(id, attempt);
  if (job == nullptr) return false;
  if (!job->isolated) job->crashes = 0;
  interrupt(*job);
  return true;
}

int StoreModel::recover() {
  int left = 0;
  for (ModelJob& job : jobs_) {
    if (!is_active(job.state)) continue;
    interrupt(job);
    ++left;
  }
  return left;
}

std::vector<std::string> StoreModel::wake_due() {
  std::vector<std::string> changed;
  for (ModelJob& job : jobs_) {
    const JobState before = job.state;
    if ((job.state == held || job.state == queued) && is_late(job)) {
      job.state = expired;
    } else if ((job.state == held || job.state == backoff) && job.wake_ms <= now_ms_) {
      job.state = queued;
    }
    if (job.state != before) changed.push_back(job.id);
  }
  return changed;
}

std::optional<JobState> StoreModel::cancel(const std::string& id) {
  ModelJob& job = at(id);
  if (is_final(job.state) && job.state != cancelled) return std::nullopt;
  return job.state = is_active(job.state) ? cancelling : cancelled;
}

std::optional<JobState> StoreModel::pause(const std::string& id) {
  ModelJob& job = at(id);
  if (is_final(job.state) || job.state == cancelling) return std::nullopt;
  return job.state = is_active(job.state) ? pausing : paused;
}

std::optional<JobState> StoreModel::resume(const std::string& id) {
  ModelJob& job = at(id);
  if (is_final(job.state) || job.state == cancelling || job.state == pausing) return std::nullopt;
  if (job.state != paused) return job.state;
  job.wake_ms = job.not_before_ms;
  return job.state = job.not_before_ms > now_ms_ ? held : queued;
}

std::optional<JobState> StoreModel::retry(const std::string& id) {
  ModelJob& job = at(id);
  if (job.state != quarantined) return std::nullopt;
  job.crashes = std::max(1, rules_.max_crashes - 1);
  job.failures = 0;
  return job.state = queued;
}

bool StoreModel::remove(const std::string& id) {
  const ModelJob& job = at(id);
  if (!is_final(job.state) || job.pinned) return false;
  jobs_.erase(std::ranges::find(jobs_, id, &ModelJob::id));
  return true;
}

std::uint64_t StoreModel::position(const ModelJob& wanted) const {
  return static_cast<std::uint64_t>(std::ranges::count_if(jobs_, [&](const ModelJob& job) {
    return job.state == queued && job.queue == wanted.queue && comes_before(job, wanted);
  }));
}

}  // namespace sculpt::server
