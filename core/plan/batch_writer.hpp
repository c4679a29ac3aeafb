// Writing beside planning: batches of keyframes go to a thread of their own, in order.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// Holds back whoever adds while more than `most_waiting` keyframes wait, so that memory stays bounded. All calls from
/// one thread.
class BatchWriter {
 public:
  static constexpr std::size_t most_waiting = 1 << 17;

  /// `write` is called on the other thread, a batch at a time, and may throw: then no more is written.
  explicit BatchWriter(std::function<void(const std::vector<Keyframe>&)> write);
  /// What was added is written first, unless writing failed.
  ~BatchWriter();

  /// Throws what writing threw.
  void add(std::vector<Keyframe> batch);
  /// Returns when all that was added is written. Throws what writing threw.
  void wait();
  /// The same, and the thread ends. Nothing may be added afterwards. Throws what writing threw.
  void finish();

 private:
  void run();
  /// Waits for a batch; false once there will be none.
  bool write_next();
  void close();

  std::function<void(const std::vector<Keyframe>&)> write_;
  std::mutex mutex_;  ///< guards what follows, up to `thread_`
  std::condition_variable changed_;
  std::deque<std::vector<Keyframe>> batches_;
  std::size_t waiting_ = 0;  ///< keyframes in `batches_`
  bool writing_ = false;     ///< a batch that is not in `batches_` any more
  bool closed_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace sculpt
