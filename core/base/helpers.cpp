#include "core/base/helpers.hpp"

#include <sched.h>

namespace sculpt {
namespace {

/// To any other core that the calling thread may run on. A new thread often begins on the core of the one that makes
/// it, and Linux has been seen to leave both there for 20 ms while another core had nothing to do.
void leave_core(int core) {
  cpu_set_t all;
  if (::sched_getaffinity(0, sizeof all, &all) != 0) return;
  cpu_set_t others = all;
  CPU_CLR(static_cast<std::size_t>(core), &others);
  if (CPU_COUNT(&others) > 0 && ::sched_setaffinity(0, sizeof others, &others) == 0)
    ::sched_setaffinity(0, sizeof all, &all);
}

}  // namespace

Helpers::Helpers(int threads) {
  for (int other = 1; other < threads; ++other)
    threads_.emplace_back([this, core = ::sched_getcpu()] {
      leave_core(core);
      stand_by();
    });
}

Helpers::~Helpers() {
  const std::lock_guard lock(mutex_);
  ending_ = true;
  changed_.notify_all();
}

void Helpers::for_each_index(std::size_t count, const std::function<void(std::size_t)>& work) const {
  Loop loop{work, std::vector<std::exception_ptr>(count)};
  const bool alone = count < 2 || threads_.empty();
  if (!alone) {
    const std::lock_guard lock(mutex_);
    open_.push_back(&loop);
    changed_.notify_all();
  }
  loop.run();
  if (!alone) {
    std::unique_lock lock(mutex_);
    close(&loop);
    // Those inside may have opened loops of their own.
    while (loop.inside > 0)
      if (!help(lock)) changed_.wait(lock);
  }
  for (const std::exception_ptr& exception : loop.thrown)
    if (exception) std::rethrow_exception(exception);
}

void Helpers::Loop::run() {
  for (std::size_t i = next++; i < thrown.size(); i = next++) {
    try {
      work(i);
    } catch (...) {
      thrown[i] = std::current_exception();
    }
  }
}

void Helpers::stand_by() const {
  std::unique_lock lock(mutex_);
  while (!ending_)
    if (!help(lock)) changed_.wait(lock);
}

/// With the outermost loop. False if there is none.
bool Helpers::help(std::unique_lock<std::mutex>& lock) const {
  if (open_.empty()) return false;
  Loop* loop = open_.front();
  ++loop->inside;
  lock.unlock();
  loop->run();
  lock.lock();
  close(loop);
  if (--loop->inside == 0) changed_.notify_all();
  return true;
}

/// Whoever has not begun with it no longer will.
void Helpers::close(const Loop* loop) const {
  std::erase(open_, loop);
}

}  // namespace sculpt
