// The handlers of the methods of proto/PROTOCOL.md, in groups, each with what it works with. Everything that a group
// refers to outlives it. All handlers run on the I/O thread; what needs time goes to a task queue.
#pragma once

#include <chrono>

#include "server/access/access.hpp"
#include "server/access/tickets.hpp"
#include "server/api/answers.hpp"
#include "server/api/dispatcher.hpp"
#include "server/base/config.hpp"
#include "server/files/blobs.hpp"
#include "server/fleet/fleet_store.hpp"
#include "server/queue/check_desk.hpp"
#include "server/queue/passed_checks.hpp"
#include "server/queue/scheduler.hpp"
#include "server/results/artifacts.hpp"
#include "server/results/motions.hpp"
#include "server/run/job_description.hpp"
#include "server/run/planner.hpp"

namespace sculpt::server {

/// hello, ping, server.info, server.schema.
struct ServerGroup {
  const Answers& answers;
  const Config& config;  ///< I/O thread only: a reload changes it
  Access& access;
  Connections& connections;
  JobStore& store;
  const Planner& planner;
  int workers;
  std::chrono::steady_clock::time_point started;
  FleetStore* fleet;  ///< null: the store is this daemon's own
};
Handlers server_handlers(const ServerGroup& group);

/// blob.has, blob.put.
struct BlobGroup {
  const Answers& answers;
  Blobs& blobs;
  TaskQueue& disk;  ///< for chunks in and out
};
Handlers blob_handlers(const BlobGroup& group);

/// job.submit.
struct SubmitGroup {
  const Answers& answers;
  const Config& config;
  JobStore& store;
  Blobs& blobs;
  const Artifacts& artifacts;  ///< of jobs that are continued
  Scheduler& scheduler;
  const Planner& planner;
  JobDefaults defaults;
  const Isolation& isolation;
  TaskQueue& admission;  ///< for all but what takes long
  CheckDesk& checks;     ///< for that: the check of those that are not known to pass it
  PassedChecks& passed;
  std::function<void(const std::string& job)> changed;  ///< tells everybody who waits for a change of its state
};
Handlers submit_handlers(const SubmitGroup& group);

/// cell.check.
struct CellGroup {
  const Answers& answers;
  const Config& config;
  Blobs& blobs;
  const Planner& planner;
  JobDefaults defaults;
  const Isolation& isolation;
  TaskQueue& admission;  ///< for all but the examination
  CheckDesk& checks;     ///< for that
};
Handlers cell_handlers(const CellGroup& group);

/// job.get, job.list, job.wait, job.report, job.verify, job.cell.
struct JobGroup {
  const Answers& answers;
  const Config& config;
  JobStore& store;
  const Scheduler& scheduler;
  Waits& waits;
  Artifacts& artifacts;
  const Blobs& blobs;
  const Isolation& isolation;
  TaskQueue& reads;
  TaskQueue& disk;
  TaskQueue& replays;
};
Handlers job_handlers(const JobGroup& group);

/// job.samples.
struct SampleGroup {
  const Answers& answers;
  JobStore& store;
  Motions& motions;
  TaskQueue& samples;  ///< for windows of motions that are known
  TaskQueue& laws;     ///< for those whose time law must be found first
};
Handlers sample_handlers(const SampleGroup& group);

/// job.cancel, job.pause, job.resume, job.retry, queue.pause, queue.resume.
struct ControlGroup {
  const Answers& answers;
  JobStore& store;
  Scheduler& scheduler;
  TaskQueue& changes;                                   ///< for commands to the store
  std::function<void(const std::string& job)> changed;  ///< tells everybody who waits for a change of its state
};
Handlers control_handlers(const ControlGroup& group);

/// events.subscribe, events.unsubscribe.
struct EventGroup {
  const Answers& answers;
  JobStore& store;
  Streams& streams;
};
Handlers event_handlers(const EventGroup& group);

/// artifact.list, artifact.read, artifact.link, artifact.pin.
struct ArtifactGroup {
  const Answers& answers;
  JobStore& store;
  Artifacts& artifacts;
  const Tickets& tickets;
  TaskQueue& changes;
  TaskQueue& disk;
  TaskQueue& exports;   ///< for other forms than an artifact's own
  TaskQueue& programs;  ///< for robot programs
};
Handlers artifact_handlers(const ArtifactGroup& group);

}  // namespace sculpt::server
