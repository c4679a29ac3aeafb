// One thread that does blocking work in order, so that the I/O thread never does.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace sculpt::server {

enum class Pace { prompt, background };

/// `add` is safe from any thread. A task must not throw; it gets the token that `stop` (or the destructor) triggers.
class TaskQueue {
 public:
  using Task = std::function<void(std::stop_token)>;

  explicit TaskQueue(Pace pace);
  ~TaskQueue() { stop(); }
  void add(Task task);
  /// Asks the running task to end, waits for it and drops the waiting ones.
  void stop();

 private:
  void work(Pace pace, std::stop_token stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::deque<Task> tasks_;
  std::jthread thread_;
};

}  // namespace sculpt::server
