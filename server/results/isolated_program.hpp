// The robot program of a finished job, written and packed in a process of its own, since that reads the job's cell
// again.
#pragma once

#include "proto/motion/program_spec.hpp"
#include "server/run/job_description.hpp"
#include "server/run/planner.hpp"

namespace sculpt::server {

inline constexpr const char* program_job_option = "--program-job";

struct ProgramQuestion {
  proto::ProgramSpec spec;
  std::string file;  ///< in the job's folder: where the process is to leave the .zip
};

/// The daemon's side: the file is there when this returns. `stored.spec` says how fast (`motion`). Throws InputError as
/// Planner::program does and `run_time_exceeded`, std::runtime_error when the process dies, Cancelled on a stop,
/// std::system_error when there can be no process.
void program_in_child(StoredSpec stored, const ProgramQuestion& question, const Isolation& isolation,
                      const std::stop_token& stop);

/// The child's side: main of a program that was started with --program-job. Gives the exit code.
int run_isolated_program(const Planner& planner);

}  // namespace sculpt::server
