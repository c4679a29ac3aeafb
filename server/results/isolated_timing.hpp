// The time law of a finished job's trajectory, found in a process of its own, since it reads the job's cell again.
#pragma once

#include "server/run/job_description.hpp"
#include "server/run/planner.hpp"

namespace sculpt::server {

inline constexpr const char* time_job_option = "--time-job";
/// What the process leaves in the job's folder, for the daemon to take.
inline constexpr const char* law_file = "motion.law";

/// The daemon's side: the law is in the job's folder when this returns. `stored.spec` says how fast (`motion`). Throws
/// InputError as Planner::time does, std::runtime_error when the process dies, Cancelled on a stop, std::system_error
/// when there can be no process.
void time_in_child(const StoredSpec& stored, const Isolation& isolation, const std::stop_token& stop);

/// The child's side: main of a program that was started with --time-job. Gives the exit code.
int run_isolated_timing(const Planner& planner);

}  // namespace sculpt::server
