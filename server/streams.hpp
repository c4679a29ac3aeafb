// Who gets the events of which job, and how far each has come: a cursor per subscriber, no queue. I/O thread only.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/base/watch.hpp"
#include "server/job_store.hpp"

namespace sculpt {

class Session;
class Scheduler;

/// Durable events are read from the store when the subscriber takes bytes; of progress only the latest is sent, and
/// none to one that lags.
class Streams {
 public:
  using Clock = std::chrono::steady_clock;

  Streams(JobStore& store, const Scheduler& scheduler) : store_(store), scheduler_(scheduler) {}

  void subscribe(const std::shared_ptr<Session>& session, const std::string& job, std::uint64_t after);
  void unsubscribe(Session& session, const std::string& job);
  /// The session is gone.
  void drop(Session& session);

  void on_changed(const std::string& job);
  void on_writable(Session& session);
  /// Call four times a second.
  void tick(Clock::time_point now);

 private:
  struct Subscription {
    std::weak_ptr<Session> session;
    std::uint64_t after = 0;  // seq of the last durable event sent
    bool live = false;
    bool ended = false;
    std::optional<Progress> told;
    Clock::time_point told_at;
  };
  using Subscribers = std::map<Session*, Subscription>;

  void advance(const std::string& job, Subscription& subscription);
  void send_durable(Session& session, const std::string& job, Subscription& subscription);
  void tell(const std::string& job, Subscription& subscription, const Progress& progress, Clock::time_point now);
  void forget_ended(const std::string& job);

  JobStore& store_;
  const Scheduler& scheduler_;
  std::map<std::string, Subscribers> jobs_;
};

}  // namespace sculpt
