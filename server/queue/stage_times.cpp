#include "server/queue/stage_times.hpp"

namespace sculpt::server {
namespace {

/// May be told from several threads.
class StageClock {
 public:
  explicit StageClock(Counters& counters) : counters_(counters) {}
  ~StageClock() { leave(Clock::now()); }
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;

  void enter(Stage stage) {
    const std::lock_guard lock(mutex_);
    if (stage_ == stage) return;
    const Clock::time_point now = Clock::now();
    leave(now);
    stage_ = stage;
    entered_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;

  void leave(Clock::time_point now) {
    if (stage_) counters_.stage_times[static_cast<std::size_t>(*stage_)].add(now - entered_);
  }

  Counters& counters_;
  std::mutex mutex_;
  std::optional<Stage> stage_;
  Clock::time_point entered_;
};

}  // namespace

RunJob with_stage_times(RunJob run, Counters& counters) {
  return [run = std::move(run), &counters](const JobRecord& job, const Watch& watch) {
    StageClock clock(counters);
    Watch timed = watch;
    timed.tell = [&](const Progress& progress) {
      clock.enter(progress.stage);
      if (watch.tell) watch.tell(progress);
    };
    return run(job, timed);
  };
}

}  // namespace sculpt::server
