// A run in a process of its own: whatever it does there, the daemon lives on. The daemon starts itself again with
// --run-job and a description of the job; progress and ending come back as lines of JSON.
#pragma once

#include "server/run/job_description.hpp"
#include "server/run/planner.hpp"
#include "server/run/run_outcome.hpp"

namespace sculpt::server {

inline constexpr const char* run_job_option = "--run-job";

/// The daemon's side. Throws CrashError when the process dies before the job has ended, Cancelled when it was asked to
/// stop.
RunJob make_isolated_run(Isolation isolation);

/// The child's side: main of a program that was started with --run-job. Gives the exit code.
int run_isolated_job(const Planner& planner);

}  // namespace sculpt::server
