#include "server/scheduler.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <new>

#include "server/crash_point.hpp"

namespace sculpt {

/// One attempt at one job: how to stop it and how far it is.
struct Scheduler::Run {
  std::stop_source stop;
  std::mutex mutex;
  std::optional<Progress> progress;
};

namespace {

// A full disk is tried again so often.
constexpr std::chrono::seconds retry_time{1};

Ending failed(const std::string& code, const std::string& sentence) {
  return {JobState::failed, code, sentence, {}};
}

/// Nothing when the job was let go.
std::optional<Ending> guarded(const RunJob& run, const JobRecord& job, const Watch& watch) {
  try {
    return run(job, watch);
  } catch (const Cancelled&) {
    return std::nullopt;
  } catch (const InputError& error) {
    return failed(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return failed("out_of_memory", "the planner ran out of memory: use a smaller resolution or mesh, or fewer workers");
  } catch (const StorageError& error) {
    return failed("storage_error", error.what());
  } catch (const std::exception& error) {
    return failed("internal_error", std::string("the planner failed: ") + error.what());
  } catch (...) {
    return failed("internal_error", "the planner failed with something that is no exception");
  }
}

}  // namespace

Scheduler::Scheduler(JobStore& store, RunJob run, std::function<void(const std::string&)> changed)
    : store_(store), run_(std::move(run)), changed_(std::move(changed)) {}

void Scheduler::start(int workers) {
  for (int i = 0; i < workers; ++i) workers_.emplace_back([this](std::stop_token stop) { work(std::move(stop)); });
}

void Scheduler::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    wake_.notify_all();
    for (const auto& [job, run] : running_) run->stop.request_stop();
  }
  for (std::jthread& worker : workers_) worker.request_stop();
  workers_.clear();
}

void Scheduler::wake() {
  {
    const std::lock_guard lock(mutex_);
    work_ = true;
  }
  wake_.notify_all();
}

void Scheduler::cancel(const std::string& job) {
  const std::lock_guard lock(mutex_);
  if (const auto found = running_.find(job); found != running_.end()) found->second->stop.request_stop();
}

std::optional<Progress> Scheduler::progress(const std::string& job) const {
  const std::lock_guard lock(mutex_);
  const auto found = running_.find(job);
  if (found == running_.end()) return std::nullopt;
  const std::lock_guard run_lock(found->second->mutex);
  return found->second->progress;
}

void Scheduler::work(std::stop_token stop) {
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

// Claims and makes the run known under one lock: a cancel that comes after the claim always finds it.
std::optional<JobRecord> Scheduler::claim(const std::shared_ptr<Run>& run) {
  const std::lock_guard lock(mutex_);
  if (stopping_) return std::nullopt;
  work_ = false;
  try {
    std::optional<JobRecord> job = store_.claim();
    if (!job) return std::nullopt;
    work_ = true;
    running_[job->id] = run;
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
                      if (progress.loose_keep > 0 && (!run.progress || run.progress->loose_keep == 0))
                        spdlog::warn("job={} {} voxels of the target hang on nothing", job.id, progress.loose_keep);
                      run.progress = progress;
                    }};
  const std::optional<Ending> ending = guarded(run_, job, watch);
  crash_point(CrashPoint::ending_known);
  while (!store_ending(job, ending)) {
    std::unique_lock lock(mutex_);
    if (wake_.wait_for(lock, retry_time, [this] { return stopping_; })) break;
  }
  crash_point(CrashPoint::ending_stored);
  const std::lock_guard lock(mutex_);
  running_.erase(job.id);
}

// False if it cannot be stored now. Given up at a stop only: then the job stays `running` in the store, and is released
// when the daemon starts again.
bool Scheduler::store_ending(const JobRecord& job, const std::optional<Ending>& ending) {
  try {
    const bool owned = ending ? store_.finish(job.id, job.attempt, *ending) : store_.release(job.id, job.attempt);
    if (!owned) spdlog::warn("job={} attempt={} does not own its job any more, result dropped", job.id, job.attempt);
    if (!ending) {
      spdlog::info("job={} attempt={} let go", job.id, job.attempt);
    } else if (ending->state == JobState::failed) {
      spdlog::warn("job={} attempt={} failed code={}: {}", job.id, job.attempt, ending->error_code,
                   ending->error_sentence);
    } else {
      spdlog::info("job={} attempt={} {}", job.id, job.attempt, name(ending->state));
    }
  } catch (const StorageError& error) {
    spdlog::error("job={} attempt={} its end cannot be stored yet: {}", job.id, job.attempt, error.what());
    return false;
  } catch (const std::exception& error) {
    spdlog::critical("job={} attempt={} its end could not be stored: {}", job.id, job.attempt, error.what());
  }
  return true;
}

}  // namespace sculpt
