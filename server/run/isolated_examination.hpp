// The examination of a cell in a process of its own: it reads a stranger's meshes, and may take long.
#pragma once

#include "server/run/job_description.hpp"
#include "server/run/planner.hpp"

namespace sculpt::server {

inline constexpr const char* check_cell_option = "--check-cell";

/// The daemon's side: what Planner::examine gives. Throws InputError `cell_invalid` when the process dies or needs
/// longer than `patience`; Cancelled on a stop; std::system_error when there can be no process.
Json examine_in_child(const std::string& cell_bundle, int resolution, const Isolation& isolation,
                      std::chrono::milliseconds patience, const std::stop_token& stop);

/// The child's side: main of a program that was started with --check-cell. Gives the exit code.
int run_isolated_examination(const Planner& planner);

}  // namespace sculpt::server
