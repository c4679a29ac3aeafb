#include "server/base/task_queue.hpp"

#include "core/base/background.hpp"

namespace sculpt::server {

TaskQueue::TaskQueue(Pace pace) : thread_([this, pace](std::stop_token stop) { work(pace, std::move(stop)); }) {}

void TaskQueue::add(Task task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  wake_.notify_one();
}

void TaskQueue::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  const std::lock_guard lock(mutex_);
  tasks_.clear();
}

void TaskQueue::work(Pace pace, std::stop_token stop) {
  if (pace == Pace::background) work_in_background();
  while (true) {
    Task task;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return !tasks_.empty(); }) || stop.stop_requested()) return;
      task = std::move(tasks_.front());
      tasks_.pop_front();
    }
    task(stop);
  }
}

}  // namespace sculpt::server
