// A planner that does what the text of its "mesh" says, without a robot: "plain", "hold" (stops half-way until the gate
// opens), "bad input" (refused before planning), "fails", "throws", "no memory", "unclean" (the replay finds
// something), "big" (8 MB of trajectory); in a process of their own "segfault", "abort", "exit", "deaf" (hears no
// stop), "prints" (to standard output), "spies" (fails with a list of what it could get hold of). Of programs the name
// says what becomes of them: "refused", "crashes", "endless", "writes_none".
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stop_token>

#include "server/run/planner.hpp"

namespace sculpt::server {

/// Closed at first.
class Gate {
 public:
  void open();
  /// Throws Cancelled when the stop comes first.
  void pass(std::stop_token stop);

 private:
  std::mutex mutex_;
  std::condition_variable_any opened_;
  bool open_ = false;
};

inline const std::string fake_header = "{\"type\":\"header\",\"format\":1}\n";
inline const std::string fake_timeline = "tokens";
inline const std::string fake_end = "{\"type\":\"end\"}\n";

/// Must outlive the server that uses its planner.
class FakePlanner {
 public:
  Gate gate;
  std::atomic<int> runs = 0;
  Planner planner();

 private:
  PlanFiles run(const Job& job, const std::filesystem::path& trajectory, const Watch& watch);
};

}  // namespace sculpt::server
