// The replay of a plan while it is made: it follows the trajectory file.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "core/plan/output/growing_file.hpp"
#include "core/verify/verify.hpp"

namespace sculpt {

/// What is replayed; it must outlive the replay.
struct ReplayTask {
  const std::filesystem::path& trajectory;
  const Cell& cell;
  const VoxelGrid& voxels;
  int threads = 1;
};

/// A job with more than one thread has its plan replayed beside the planner, by one of low priority, so that it takes a
/// core where one is idle; once the plan is whole the others help. With one thread the replay is done at the end. The
/// verdict is the same. All calls but `grow` and `replayed` from one thread.
class ReplayBeside {
 public:
  /// Reads nothing before `grow`. `done`: by an earlier replay of the same trajectory. Calls `alarm` once, from another
  /// thread, when something was found or the replay failed before the file was whole: the plan is of no use then.
  ReplayBeside(const ReplayTask& task, ReplayedPieces done, std::function<void()> alarm);
  /// Gives up what is not done.
  ~ReplayBeside();

  /// More of the file can be read.
  void grow() { file_.grow(); }
  /// The file is whole.
  void end() { file_.end(); }
  /// Whether `alarm` was called.
  bool alarmed() const { return alarmed_; }
  /// So far.
  ReplayedPieces replayed() const;

  /// After `end`. `waiting` is called now and then, on this thread; what it throws passes through. So does what the
  /// replay throws.
  Verdict wait(const Watch& watch, const std::function<void()>& waiting);

 private:
  void run();
  void note(const ReplayedPieces& replayed);
  void sound_alarm();

  ReplayTask task_;
  std::function<void()> alarm_;
  std::atomic<bool> alarmed_ = false;
  GrowingFile file_;
  std::stop_source stop_;
  std::atomic<std::uint64_t> removed_ = 0, to_remove_ = 0;  ///< voxels replayed, for the watch
  mutable std::mutex mutex_;                                ///< of what follows
  std::condition_variable changed_;
  ReplayedPieces replayed_;
  std::optional<Verdict> verdict_;
  std::exception_ptr failure_;
  std::thread thread_;  ///< none with one thread
};

}  // namespace sculpt
