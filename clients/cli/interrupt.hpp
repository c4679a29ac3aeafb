// Ctrl-C and SIGTERM as a call on a thread of its own, so that what happens then may do anything.
#pragma once

#include <functional>
#include <thread>

namespace sculpt::cli {

/// From construction to destruction SIGINT and SIGTERM do not end the process: the first one calls `action` once, a
/// second one ends the process. Construct it before any other thread starts: threads inherit the blocked signals.
class Interrupt {
 public:
  explicit Interrupt(std::function<void()> action);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

 private:
  std::jthread waiter_;
};

}  // namespace sculpt::cli
