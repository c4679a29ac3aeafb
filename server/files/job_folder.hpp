// The folder of a job's files: jobs/ID, or where several daemons may run the job jobs/ID/ATTEMPT, one for each attempt.
#pragma once

#include <filesystem>
#include <string>

namespace sculpt::server {

/// Makes jobs/FOLDER for a run, durably, and gives its path. What an earlier run left stays, to go on from: checkpoints
/// and trajectory, not what was made of its result, and no links. A folder of an attempt gets a copy of the last one's,
/// whose run may not know yet that it lost its job and still write there; those before are removed. Throws
/// StorageError and std::filesystem::filesystem_error.
std::filesystem::path prepare_job_folder(const std::filesystem::path& jobs, const std::string& folder);

/// Removes what other attempts left of a job that has ended in jobs/FOLDER.
void remove_other_attempts(const std::filesystem::path& jobs, const std::string& folder);

}  // namespace sculpt::server
