#include "server/queue/check_desk.hpp"

#include <algorithm>

namespace sculpt::server {

CheckDesk::CheckDesk(int at_once) : at_once_(at_once) {
  for (int i = 0; i < at_once; ++i) threads_.emplace_back([this](const std::stop_token& stop) { work(stop); });
}

void CheckDesk::add(const std::string& client, Task task) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({client, std::move(task)});
  }
  wake_.notify_one();
}

void CheckDesk::stop() {
  for (std::jthread& thread : threads_) thread.request_stop();
  threads_.clear();
  const std::lock_guard lock(mutex_);
  waiting_.clear();
}

int CheckDesk::at_work(const std::string& client) const {
  const auto found = at_work_.find(client);
  return found == at_work_.end() ? 0 : found->second;
}

// Call with the mutex held. The end if nobody who waits may have another thread.
std::deque<CheckDesk::Waiting>::iterator CheckDesk::next() {
  const auto first =
      std::ranges::min_element(waiting_, {}, [this](const Waiting& waiting) { return at_work(waiting.client); });
  return first == waiting_.end() || at_work(first->client) >= at_once_ - 1 ? waiting_.end() : first;
}

void CheckDesk::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return next() != waiting_.end(); }) && !stop.stop_requested()) {
    const auto chosen = next();
    Waiting now = std::move(*chosen);
    waiting_.erase(chosen);
    ++at_work_[now.client];
    lock.unlock();
    now.task(stop);
    now.task = nullptr;
    lock.lock();
    if (--at_work_[now.client] == 0) at_work_.erase(now.client);
    wake_.notify_all();  // the client's next may have been waiting for that
  }
}

}  // namespace sculpt::server
