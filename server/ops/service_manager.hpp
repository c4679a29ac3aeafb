// What the service manager (systemd, or whatever set $NOTIFY_SOCKET) is told: ready, reloading, stopping, alive.
//
// The protocol is one datagram of NAME=VALUE lines, stable for ten years: that is less code than a dependency on
// libsystemd, and works where there is none.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <chrono>
#include <optional>
#include <string>

#include "server/store/job_store.hpp"

namespace sculpt::server {

/// Does nothing where nobody asked to be told. One thread.
class ServiceManager {
 public:
  using Clock = std::chrono::steady_clock;

  /// Reads $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID.
  ServiceManager();
  ~ServiceManager();
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  bool listens() const { return socket_ >= 0; }
  void ready() { tell("READY=1"); }
  /// Followed by `ready`.
  void reloading();
  void stopping() { tell("STOPPING=1"); }
  /// A line for people; sent when it differs from the one before.
  void status(const std::string& sentence);
  /// Call several times a second from the thread that must not hang: twice in the watchdog's time it is told so.
  void alive(Clock::time_point now);

 private:
  void tell(const std::string& lines);

  int socket_ = -1;
  sockaddr_un address_{};
  socklen_t address_bytes_ = 0;
  std::optional<Clock::duration> beat_;  // nothing: no watchdog
  Clock::time_point told_at_{};
  std::string status_;
};

/// Of the queue, as a status.
std::string queue_sentence(JobStore& store);

}  // namespace sculpt::server
