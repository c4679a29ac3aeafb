// What the handlers work with. Owned by Server, which outlives every session.
#pragma once

#include <chrono>

#include "server/artifacts.hpp"
#include "server/blobs.hpp"
#include "server/check_desk.hpp"
#include "server/config.hpp"
#include "server/connection.hpp"
#include "server/counters.hpp"
#include "server/job_description.hpp"
#include "server/job_store.hpp"
#include "server/net.hpp"
#include "server/passed_checks.hpp"
#include "server/planner.hpp"
#include "server/scheduler.hpp"
#include "server/streams.hpp"
#include "server/task_queue.hpp"
#include "server/translate.hpp"
#include "server/waits.hpp"

namespace sculpt {

struct Services {
  net::io_context& io;
  const Config& config;  ///< I/O thread only: a reload changes it
  const Planner& planner;
  JobDefaults defaults;
  int workers;
  JobStore& store;
  Blobs& blobs;
  Artifacts& artifacts;
  Scheduler& scheduler;
  Streams& streams;          // I/O thread only
  Waits& waits;              // I/O thread only
  Access& access;            // I/O thread only
  Connections& connections;  // I/O thread only
  TaskQueue& reads;          ///< questions to the store
  TaskQueue& changes;        ///< commands to it
  TaskQueue& disk;           ///< chunks in and out
  TaskQueue& admission;      ///< of submitted jobs, but for what takes long
  CheckDesk& checks;         ///< that: the check of those that are not known to pass it
  TaskQueue& replays;        ///< job.verify
  TaskQueue& exports;        ///< csv and binary trajectories
  const Isolation& isolation;
  PassedChecks& passed;
  Counters& counters;
  std::chrono::steady_clock::time_point started;

  /// A job changed its state: tells everybody who waits for that. Any thread.
  void changed(const std::string& job);
};

}  // namespace sculpt
