// Who gets the events of which job, and how far each has come: a cursor per subscriber, no queue. I/O thread only.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/watch.hpp"
#include "server/net/net.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

class Scheduler;
class Session;
class TaskQueue;

/// Durable events are read from the store, on the thread of reads, when the subscriber takes bytes; of progress only
/// the latest is sent, and none to one that lags. The job "" stands for all jobs: such a subscription gets state events
/// only, counts by their number, and does not end by itself.
class Streams {
 public:
  using Clock = std::chrono::steady_clock;

  Streams(net::io_context& io, JobStore& store, TaskQueue& reads, const Scheduler& scheduler)
      : io_(io), store_(store), reads_(reads), scheduler_(scheduler) {}

  /// In the place of one that there was. Nothing happens if the session is closed.
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
    std::shared_ptr<Session> session;  // until it is closed: drop
    std::uint64_t serial = 0;          // tells it from those before it of the same session and job
    std::uint64_t after = 0;           // seq (of all jobs: number) of the last durable event sent
    bool reading = false;              // the store is being asked
    bool behind = true;                // there may be events that were not read
    bool live = false;
    bool ended = false;
    std::optional<Progress> told;
    Clock::time_point told_at;
  };
  using Subscribers = std::map<Session*, Subscription>;

  Subscription* find(const std::string& job, Session* session, std::uint64_t serial);
  void advance(const std::string& job, Subscription& subscription);
  void take(const std::string& job, Subscription& subscription, const std::vector<StateEvent>& events);
  void tell(const std::string& job, Subscription& subscription, const Progress& progress, Clock::time_point now);

  net::io_context& io_;
  JobStore& store_;
  TaskQueue& reads_;
  const Scheduler& scheduler_;
  std::map<std::string, Subscribers> jobs_;
  std::uint64_t last_serial_ = 0;
};

}  // namespace sculpt::server
