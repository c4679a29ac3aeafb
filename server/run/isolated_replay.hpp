// The replay of a finished job's trajectory in a process of its own, since it reads the job's files again.
#pragma once

#include "server/run/job_description.hpp"
#include "server/run/planner.hpp"

namespace sculpt::server {

inline constexpr const char* replay_job_option = "--replay-job";

/// The daemon's side. Throws InputError as Planner::verify does, std::runtime_error when the process dies, Cancelled on
/// a stop, std::system_error when there can be no process.
Replay replay_in_child(const StoredSpec& stored, const Isolation& isolation, const std::stop_token& stop);

/// The child's side: main of a program that was started with --replay-job. Gives the exit code.
int run_isolated_replay(const Planner& planner);

}  // namespace sculpt::server
