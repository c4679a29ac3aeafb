#include "server/queue/scheduler.hpp"

#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <new>
#include <system_error>

#include "core/base/background.hpp"
#include "server/base/crash_point.hpp"
#include "server/files/durable.hpp"

namespace sculpt::server {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds beat{250};

}  // namespace

/// One attempt at one job: how to stop it, when it has to be over, and how far it is.
struct Scheduler::Run {
  std::optional<Clock::time_point> deadline;  // set before anybody else sees the run
  std::atomic<bool> overdue = false;
  std::stop_source stop;
  std::mutex mutex;
  std::optional<Progress> progress;
};

namespace {

// A full disk is tried again so often.
constexpr std::chrono::seconds retry_time{1};

Ending overdue(const JobRecord& job) {
  return {JobState::failed,
          "run_time_exceeded",
          "it ran longer than its max_runtime_s, " + std::to_string(job.schedule.max_runtime_s) +
              ": submit it with more, or with a lower resolution",
          {},
          Cause::job};
}

/// Once, when they are known.
void log_doubts(const JobRecord& job, const Doubts& doubts) {
  if (doubts.loose_keep > 0)
    spdlog::log(doubts.is_much_loose() ? spdlog::level::warn : spdlog::level::info,
                "job={} {} of {} voxels of the target hang on nothing", job.id, doubts.loose_keep, doubts.keep);
  const auto& [x, y, z] = doubts.ambiguous_at_mm;
  if (doubts.ambiguous > 0)
    spdlog::warn(
        "job={} its mesh does not say for sure whether {} voxels around ({:.1f}, {:.1f}, {:.1f}) mm are inside", job.id,
        doubts.ambiguous, x, y, z);
}

void log_ending(const JobRecord& job, const std::optional<Ending>& ending) {
  if (!ending) {
    spdlog::info("job={} attempt={} let go", job.id, job.attempt);
  } else if (ending->state == JobState::failed) {
    spdlog::warn("job={} attempt={} failed code={}: {}", job.id, job.attempt, ending->error_code,
                 ending->error_sentence);
  } else {
    spdlog::info("job={} attempt={} {}", job.id, job.attempt, name(ending->state));
  }
}

}  // namespace

Scheduler::Scheduler(JobStore& store, RunJob run, std::function<void(const std::string&)> changed)
    : store_(store), run_(std::move(run)), changed_(std::move(changed)) {}

void Scheduler::start(int workers) {
  for (int i = 0; i < workers; ++i) threads_.emplace_back([this](std::stop_token stop) { work(std::move(stop)); });
  threads_.emplace_back([this](const std::stop_token& stop) { mind_time(stop); });
}

void Scheduler::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    wake_.notify_all();
    for (const auto& [job, run] : running_) run->stop.request_stop();
  }
  for (std::jthread& thread : threads_) thread.request_stop();
  threads_.clear();
}

void Scheduler::wake() {
  {
    const std::lock_guard lock(mutex_);
    work_ = true;
  }
  wake_.notify_all();
}

void Scheduler::stop_run(const std::string& job) {
  const std::lock_guard claiming(claiming_);
  abandon_run(job);
}

void Scheduler::abandon_run(const std::string& job) {
  const std::lock_guard lock(mutex_);
  if (const auto found = running_.find(job); found != running_.end()) found->second->stop.request_stop();
}

std::optional<Progress> Scheduler::progress(const std::string& job) const {
  std::optional<Progress> here = progress_here(job);
  return here || !elsewhere_ ? here : elsewhere_(job);
}

std::optional<Progress> Scheduler::progress_here(const std::string& job) const {
  const std::lock_guard lock(mutex_);
  const auto found = running_.find(job);
  if (found == running_.end()) return std::nullopt;
  const std::lock_guard run_lock(found->second->mutex);
  return found->second->progress;
}

void Scheduler::work(std::stop_token stop) {
  work_in_background();
  while (!stop.stop_requested()) {
    const auto run = std::make_shared<Run>();
    const std::optional<JobRecord> job = claim(run);
    if (job) {
      changed_(job->id);
      run_one(*job, *run);
      changed_(job->id);
    } else {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, stop, retry_time, [this] { return work_; });
    }
  }
}

void Scheduler::mind_time(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    stop_overdue();
    lock.unlock();
    wake_due();
    lock.lock();
    time_.wait_for(lock, stop, beat, [] { return false; });
  }
}

// Call with the mutex held.
void Scheduler::stop_overdue() {
  const auto now = Clock::now();
  for (const auto& [job, run] : running_) {
    if (!run->deadline || now < *run->deadline) continue;
    run->overdue = true;
    run->stop.request_stop();
  }
}

void Scheduler::wake_due() {
  try {
    const std::vector<std::string> woken = store_.wake_due();
    for (const std::string& job : woken) changed_(job);
    if (!woken.empty()) wake();
  } catch (const std::exception& error) {
    spdlog::error("jobs whose time has come cannot be queued: {}", error.what());
  }
}

// Claims and makes the run known in one step: a cancel that comes after the claim always finds it.
std::optional<JobRecord> Scheduler::claim(const std::shared_ptr<Run>& run) {
  const std::lock_guard claiming(claiming_);
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) return std::nullopt;
    work_ = false;
  }
  try {
    std::optional<JobRecord> job = store_.claim();
    if (!job) return std::nullopt;
    if (job->schedule.max_runtime_s > 0)
      run->deadline = Clock::now() + std::chrono::seconds(job->schedule.max_runtime_s);
    const std::lock_guard lock(mutex_);
    work_ = true;
    running_[job->id] = run;
    if (stopping_) run->stop.request_stop();
    return job;
  } catch (const std::exception& error) {
    // Tried again after retry_time, so that a full disk does not make the worker spin.
    spdlog::error("a worker cannot claim a job: {}", error.what());
    return std::nullopt;
  }
}

void Scheduler::run_one(const JobRecord& job, Run& run) {
  spdlog::info("job={} attempt={} running", job.id, job.attempt);
  const Watch watch{run.stop.get_token(), [&run, &job](const Progress& progress) {
                      const std::lock_guard lock(run.mutex);
                      if (!run.progress || run.progress->doubts.keep == 0) log_doubts(job, progress.doubts);
                      run.progress = progress;
                    }};
  std::optional<Ending> ending;
  try {
    ending = run_(job, watch);
  } catch (...) {
    ending = caught_ending();
  }
  if (!ending && run.overdue) ending = overdue(job);
  crash_point(CrashPoint::ending_known);
  while (!store_ending(job, ending)) {
    std::unique_lock lock(mutex_);
    if (wake_.wait_for(lock, retry_time, [this] { return stopping_; })) break;
  }
  crash_point(CrashPoint::ending_stored);
  end_run(job.id, run);
}

// Another worker may run the job again by now. What waited for memory, or for its turn as a suspect, may have room.
void Scheduler::end_run(const std::string& job, const Run& run) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = running_.find(job); found->second.get() == &run) running_.erase(found);
  }
  wake();
}

// False if it cannot be stored now. Given up at a stop only: then the job stays `running` in the store, and is released
// when the daemon starts again.
bool Scheduler::store_ending(const JobRecord& job, const std::optional<Ending>& ending) {
  try {
    const bool owned = ending ? store_.finish(job.id, job.attempt, *ending) : store_.release(job.id, job.attempt);
    if (!owned) spdlog::warn("job={} attempt={} does not own its job any more, result dropped", job.id, job.attempt);
    log_ending(job, ending);
  } catch (const StorageError& error) {
    spdlog::error("job={} attempt={} its end cannot be stored yet: {}", job.id, job.attempt, error.what());
    return false;
  } catch (const std::exception& error) {
    spdlog::critical("job={} attempt={} its end could not be stored: {}", job.id, job.attempt, error.what());
  }
  return true;
}

}  // namespace sculpt::server
