#include "clients/cli/interrupt.hpp"

#include <csignal>
#include <cstdlib>

#include "clients/cli/exit_code.hpp"

namespace sculpt::cli {

namespace {

sigset_t interrupts() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

Interrupt::Interrupt(std::function<void()> action) {
  const sigset_t set = interrupts();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  waiter_ = std::jthread([action = std::move(action)](std::stop_token stop) {
    const sigset_t waited = interrupts();
    for (int seen = 0, signal = 0; sigwait(&waited, &signal) == 0 && !stop.stop_requested(); ++seen) {
      if (seen > 0) std::_Exit(exit_failed);
      action();
    }
  });
}

Interrupt::~Interrupt() {
  waiter_.request_stop();
  pthread_kill(waiter_.native_handle(), SIGINT);  // wakes sigwait
  waiter_.join();
  const sigset_t set = interrupts();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

}  // namespace sculpt::cli
