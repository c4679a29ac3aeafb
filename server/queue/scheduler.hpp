// Worker threads: claim a queued job, run it, store how it ended. One more thread minds the time.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/run/run_outcome.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

/// All methods are safe from any thread. Between them and a worker stands one mutex, which is never held while a job
/// runs or the store is asked; only stop_run waits for a claim that is being written.
class Scheduler {
 public:
  /// `changed` is called after each change of a job's state, on the thread that made it, and must not throw.
  Scheduler(JobStore& store, RunJob run, std::function<void(const std::string& job)> changed);
  ~Scheduler() { stop(); }

  void start(int workers);
  /// Asks every running job to end and waits for the workers; the jobs go back to the queue. Idempotent.
  void stop();
  /// There may be a queued job.
  void wake();
  /// Asks a job to stop if it runs. Call after the store says `cancelling` or `pausing`.
  void stop_run(const std::string& job);
  /// The same without waiting for a claim, for a job that another daemon has, or may take at any time.
  void abandon_run(const std::string& job);
  /// Nothing if the job does not run, here or elsewhere.
  std::optional<Progress> progress(const std::string& job) const;
  /// Nothing if the job does not run here.
  std::optional<Progress> progress_here(const std::string& job) const;
  /// Who knows of runs in other daemons. Call before anybody else uses this.
  void ask_elsewhere(std::function<std::optional<Progress>(const std::string& job)> elsewhere) {
    elsewhere_ = std::move(elsewhere);
  }

 private:
  struct Run;
  void work(std::stop_token stop);
  void mind_time(const std::stop_token& stop);
  void stop_overdue();
  void wake_due();
  std::optional<JobRecord> claim(const std::shared_ptr<Run>& run);
  void run_one(const JobRecord& job, Run& run);
  void end_run(const std::string& job, const Run& run);
  bool store_ending(const JobRecord& job, const std::optional<Ending>& ending);

  JobStore& store_;
  RunJob run_;
  std::function<void(const std::string&)> changed_;
  std::function<std::optional<Progress>(const std::string&)> elsewhere_;
  std::mutex claiming_;  // a claim and the run that it makes known are one step; taken before mutex_
  mutable std::mutex mutex_;
  std::condition_variable_any wake_, time_;
  bool work_ = true;  // a claim may find something
  bool stopping_ = false;
  std::map<std::string, std::shared_ptr<Run>> running_;
  std::vector<std::jthread> threads_;
};

}  // namespace sculpt::server
