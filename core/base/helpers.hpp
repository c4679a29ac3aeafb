// The same work on several things, on several threads.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace sculpt {

/// Threads that sleep until one of their owner's loops has work for them. They inherit the priority of the thread that
/// makes them. (oneTBB would do, but ThreadSanitizer cannot see into it.)
class Helpers {
 public:
  /// `threads`: in all, the one that asks is one of them.
  Helpers(int threads);
  ~Helpers();
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;

  /// That of the one that asks among them.
  int threads() const { return 1 + static_cast<int>(threads_.size()); }

  /// Calls `work(i)` once for every i below `count`, on the thread that asks and on those that are free. Returns when
  /// all are done; if some threw, rethrows what the lowest i threw. Any thread, also from within `work`.
  void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work) const;

 private:
  struct Loop {
    const std::function<void(std::size_t)>& work;
    std::vector<std::exception_ptr> thrown;
    std::atomic<std::size_t> next{0};
    int inside = 0;  ///< helpers

    /// Until no index is left.
    void run();
  };

  void stand_by() const;
  bool help(std::unique_lock<std::mutex>& lock) const;
  void close(const Loop* loop) const;

  mutable std::mutex mutex_;  ///< of all but the threads
  mutable std::condition_variable changed_;
  mutable std::vector<Loop*> open_;  ///< those that may have an index left, outer ones first
  bool ending_ = false;
  std::vector<std::jthread> threads_;
};

}  // namespace sculpt
