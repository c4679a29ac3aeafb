// The check of a job whose files nobody has read yet, in a process of its own: a reader that a broken mesh makes crash,
// or go on for ever, takes nobody with it. Such readers are known (assimp 5.2 and .ply).
#pragma once

#include "server/run/job_description.hpp"
#include "server/run/planner.hpp"

namespace sculpt::server {

inline constexpr const char* check_job_option = "--check-job";

/// The daemon's side. Throws InputError as Planner::check does, and `mesh_unreadable` when the process dies or needs
/// longer than `patience`; Cancelled on a stop; std::system_error when there can be no process.
void check_in_child(StoredSpec stored, const Isolation& isolation, std::chrono::milliseconds patience,
                    const std::stop_token& stop);

/// The child's side: main of a program that was started with --check-job. Gives the exit code.
int run_isolated_check(const Planner& planner);

}  // namespace sculpt::server
