// Work that waits for processes of its own, several at once: nobody waits for what another asked for.
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/base/task_queue.hpp"

namespace sculpt::server {

/// As TaskQueue, with `at_once` (at least 2) threads. Of those one client gets all but one; among the waiting tasks the
/// next is the first of a client that has the fewest at work.
class CheckDesk {
 public:
  using Task = TaskQueue::Task;

  explicit CheckDesk(int at_once);
  ~CheckDesk() { stop(); }
  void add(const std::string& client, Task task);
  /// Asks the running tasks to end, waits for them and drops the waiting ones.
  void stop();

 private:
  struct Waiting {
    std::string client;
    Task task;
  };
  void work(const std::stop_token& stop);
  int at_work(const std::string& client) const;
  std::deque<Waiting>::iterator next();

  int at_once_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::deque<Waiting> waiting_;
  std::map<std::string, int> at_work_;  // by client, none is 0
  std::vector<std::jthread> threads_;
};

}  // namespace sculpt::server
