// The thread that looks at what the other daemons do: once a second, and at once when the database says that there is
// something. That word is a hint; the look is what counts.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "core/base/watch.hpp"
#include "server/fleet/fleet_feed.hpp"
#include "server/fleet/postgres.hpp"

namespace sculpt::server {

class FleetFollower {
 public:
  using Changed = std::function<void(const std::string& job, JobState to)>;

  FleetFollower(const PostgresSource& source, FleetFeed& feed);
  ~FleetFollower() { stop(); }

  /// `changed` is told of what other daemons do, on this thread.
  void start(Changed changed);
  void stop();
  /// Of a job that any daemon runs, as of the last look. Any thread.
  std::optional<Progress> progress(const std::string& job) const;

 private:
  void work(const std::stop_token& stop);
  void look();
  void listen();
  std::chrono::milliseconds next_look();

  Postgres database_;
  FleetFeed& feed_;
  Changed changed_;
  std::uint64_t listening_ = 0;  // the connection that does
  std::minstd_rand random_{std::random_device{}()};
  mutable std::mutex mutex_;
  std::map<std::string, Progress> progress_;
  std::jthread thread_;
};

}  // namespace sculpt::server
