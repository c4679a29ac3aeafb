// Writing beside planning: batches of keyframes go to a thread of their own, in order.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <variant>
#include <vector>

#include "core/trajectory/keyframe.hpp"

namespace sculpt {

/// Added between batches: a run could go on after what was added before it.
struct Mark {};

/// Holds back whoever adds while more than `max_waiting` keyframes wait, so that memory stays bounded. All calls from
/// one thread.
class BatchWriter {
 public:
  static constexpr std::size_t max_waiting = 1 << 17;

  /// Both are called on the other thread, `write` with a batch at a time, and may throw: then no more is written.
  explicit BatchWriter(
      std::function<void(const std::vector<Keyframe>&)> write, std::function<void()> mark = [] {});
  /// What was added is written first, unless writing failed.
  ~BatchWriter();

  /// Both throw what writing threw.
  void add(std::vector<Keyframe> batch);
  void add(Mark);
  /// Returns when all that was added is written. Throws what writing threw.
  void wait();
  /// The same, and the thread ends. Nothing may be added afterwards. Throws what writing threw.
  void finish();

 private:
  using Part = std::variant<std::vector<Keyframe>, Mark>;

  void add(Part part, std::size_t keyframes);
  void run();
  /// Waits for a part; false once there will be none.
  bool write_next();
  void close();

  std::function<void(const std::vector<Keyframe>&)> write_;
  std::function<void()> mark_;
  std::mutex mutex_;  ///< guards what follows, up to `thread_`
  std::condition_variable changed_;
  std::deque<Part> parts_;
  std::size_t waiting_ = 0;  ///< keyframes in `parts_`
  bool writing_ = false;     ///< a part that is not in `parts_` any more
  bool closed_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace sculpt
