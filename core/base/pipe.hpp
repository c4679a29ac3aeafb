// What one thread makes is taken up by another, in order.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace sculpt {

/// Hands on items in batches, so that locks cost nothing beside the work. Its owner's thread puts them in.
template <typename Item>
class Pipe {
 public:
  /// `take` is called with each item: on a thread of its own, or `beside` is false and it is called by `put`.
  Pipe(std::function<void(const Item&)> take, bool beside) : take_(std::move(take)) {
    if (beside) thread_ = std::thread([this] { run(); });
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  /// What was not taken up yet is dropped.
  ~Pipe() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
      waiting_.clear();
    }
    changed_.notify_all();
    thread_.join();
  }

  /// Throws what `take` threw of an item before; then nothing is taken up any more.
  void put(const Item& item) {
    if (!thread_.joinable()) return take_(item);
    batch_.push_back(item);
    if (batch_.size() == items_a_batch) hand_on();
  }

  /// Returns when all was taken up. Throws what `take` threw.
  void finish() {
    if (!thread_.joinable()) return;
    hand_on();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return thrown_ || (waiting_.empty() && !taking_); });
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  static constexpr std::size_t items_a_batch = 256, max_waiting = 64;

  void hand_on() {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return thrown_ || waiting_.size() < max_waiting; });
      if (thrown_) std::rethrow_exception(thrown_);
      waiting_.push_back(std::exchange(batch_, {}));
    }
    changed_.notify_all();
  }

  void run() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return ended_ || !waiting_.empty(); });
      if (ended_) return;
      const std::vector<Item> batch = std::move(waiting_.front());
      waiting_.pop_front();
      taking_ = true;
      lock.unlock();
      std::exception_ptr thrown;
      try {
        for (const Item& item : batch) take_(item);
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      taking_ = false;
      thrown_ = thrown;
      changed_.notify_all();
      if (thrown_) return;
    }
  }

  std::function<void(const Item&)> take_;
  std::vector<Item> batch_;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  std::deque<std::vector<Item>> waiting_;
  bool taking_ = false, ended_ = false;
  std::exception_ptr thrown_;
  std::thread thread_;
};

}  // namespace sculpt
