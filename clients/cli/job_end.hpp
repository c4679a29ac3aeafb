// Waiting for the end of a job, and what that end means for the exit code.
#pragma once

#include <string>

#include "clients/cli/progress_line.hpp"
#include "clients/cpp/client.hpp"

namespace sculpt::cli {

/// Tells `progress` of every change until the job ends; gives the job as job.get does.
Json follow_job(client::Client& client, const std::string& job, ProgressLine& progress);

/// Returns when the job has ended, with the job as job.get gives it. Silent.
Json wait_job(client::Client& client, const std::string& job);

/// 0 for a job that succeeded; else says on stderr why not, and 1.
int end_exit_code(const Json& job);

}  // namespace sculpt::cli
