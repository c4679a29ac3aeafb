#include "core/plan/replay_beside.hpp"

#include <chrono>
#include <fstream>
#include <utility>

#include "core/base/background.hpp"

namespace sculpt {
namespace {

constexpr std::chrono::milliseconds look_every(50);

}  // namespace

ReplayBeside::ReplayBeside(const ReplayTask& task, ReplayedPieces done, std::function<void()> alarm)
    : task_(task), alarm_(std::move(alarm)), file_(task_.trajectory), replayed_(std::move(done)) {
  if (task_.threads > 1) thread_ = std::thread([this] { run(); });
}

ReplayBeside::~ReplayBeside() {
  stop_.request_stop();
  file_.give_up();
  if (thread_.joinable()) thread_.join();
}

void ReplayBeside::sound_alarm() {
  if (!file_.ended() && !alarmed_.exchange(true)) alarm_();
}

void ReplayBeside::run() {
  std::optional<Verdict> verdict;
  std::exception_ptr failure;
  try {
    const Watch watch{stop_.get_token(), [this](const Progress& at) {
                        removed_ = at.done;
                        to_remove_ = at.total;
                      }};
    // Asked first when there are other threads already, which keep theirs.
    const auto alone = [this, lowered = false]() mutable {
      if (!std::exchange(lowered, true)) work_in_background();
      return !file_.ended();
    };
    const ReplaySettings settings{task_.threads, false, alone};
    verdict = verify_trajectory(file_.in(), task_.cell, task_.voxels, watch, settings, replayed(),
                                [this](const ReplayedPieces& so_far) { note(so_far); });
  } catch (...) {
    failure = std::current_exception();
    sound_alarm();
  }
  {
    const std::lock_guard lock(mutex_);
    verdict_ = std::move(verdict);
    failure_ = failure;
  }
  changed_.notify_all();
}

void ReplayBeside::note(const ReplayedPieces& replayed) {
  {
    const std::lock_guard lock(mutex_);
    replayed_ = replayed;
  }
  if (replayed.found.collisions > 0) sound_alarm();
}

ReplayedPieces ReplayBeside::replayed() const {
  const std::lock_guard lock(mutex_);
  return replayed_;
}

Verdict ReplayBeside::wait(const Watch& watch, const std::function<void()>& waiting) {
  if (!thread_.joinable()) {
    std::ifstream in(task_.trajectory, std::ios::binary);
    return verify_trajectory(in, task_.cell, task_.voxels, watch, {}, replayed(), [&](const ReplayedPieces& so_far) {
      note(so_far);
      waiting();
    });
  }
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, look_every, [this] { return verdict_ || failure_; })) {
    lock.unlock();
    watch.step(Stage::verify, removed_, to_remove_);
    waiting();
    lock.lock();
  }
  if (failure_) std::rethrow_exception(failure_);
  return *std::move(verdict_);
}

}  // namespace sculpt
