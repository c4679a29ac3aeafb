// The jobs that this daemon runs, and its hold on them: a lease in the database, renewed by a thread of its own.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "core/base/watch.hpp"
#include "server/fleet/fleet_member.hpp"
#include "server/fleet/postgres.hpp"
#include "server/store/job_record.hpp"

namespace sculpt::server {

/// All methods are safe from any thread.
class FleetLeases {
 public:
  using Clock = std::chrono::steady_clock;

  FleetLeases(const PostgresSource& source, FleetMember member, std::chrono::milliseconds lease);
  ~FleetLeases() { stop(); }

  /// Begins to renew, as a daemon of this address (HOST:PORT, for people). `hooks.lost` is told once of each job whose
  /// lease is gone, or will be before it can be renewed; `hooks.progress` is asked how far a job is. Both on threads of
  /// the leases.
  void start(const FleetHooks& hooks, const std::string& address);
  /// What is held is not renewed any more.
  void stop();

  /// The job was claimed; `since`: from before the claim was asked for, by which the lease counts.
  void hold(const JobRecord& job, Clock::time_point since);
  void let_go(const std::string& job, int attempt);
  void let_go_all();
  /// Whether any attempt at it is held.
  bool holds(const std::string& job) const;
  AtWork at_work() const;

  /// This daemon is the one that removes what is old.
  bool sweeps() const { return sweeps_; }
  std::uint64_t lost() const { return lost_; }
  /// See FleetStore; before the first renewal this machine's own.
  std::uint64_t now_ms() const;
  DatabaseFigures figures() const;

 private:
  struct Held {
    int attempt = 0;
    std::uint64_t memory_bytes = 0;
    bool suspect = false;          // it runs in a process of its own because it is suspected
    Clock::time_point safe_until;  // by then the run has to be over, unless renewed
    bool lost = false;
  };
  void work(const std::stop_token& stop);
  void mind(const std::stop_token& stop);
  void await_beat(const std::stop_token& stop);
  void beat();
  void renew(const std::map<std::string, Held>& held, Clock::time_point since);
  void take_sweep();
  void measure();
  void give_up_late();

  Postgres database_;
  FleetMember member_;
  std::chrono::milliseconds lease_, beat_;
  FleetHooks hooks_;
  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  std::map<std::string, Held> held_;
  DatabaseFigures figures_;
  std::atomic<bool> sweeps_ = false;
  std::atomic<std::uint64_t> lost_ = 0;
  std::atomic<std::int64_t> ahead_ms_;  // the database's wall time of our steady one
  std::uint64_t sweep_generation_ = 0, beats_ = 0;
  std::string address_;
  std::jthread renewing_, minding_;
};

}  // namespace sculpt::server
