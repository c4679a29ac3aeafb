// The folder of a job's files: jobs/ID, or where several daemons may run the job jobs/ID/ATTEMPT, one for each attempt.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sculpt::server {

/// Makes jobs/FOLDER for a run, durably, and gives its path. What an earlier run left stays, to go on from: checkpoints
/// and trajectory, not what was made of its result, and no links. A folder of an attempt gets a copy of the last one's,
/// whose run may not know yet that it lost its job and still write there; those before are removed. Throws
/// StorageError and std::filesystem::filesystem_error.
std::filesystem::path prepare_job_folder(const std::filesystem::path& jobs, const std::string& folder);

/// The number of a folder that an attempt has; nothing of another.
std::optional<int> attempt_of(const std::filesystem::path& folder);
/// The last attempt of the same job that has a folder beside this one, and a lower number; 0: none.
int last_attempt(const std::filesystem::path& folder);
/// What a run has written so far that is worth keeping: no drafts, links, nor what is made from results.
std::vector<std::filesystem::path> files_of_run(const std::filesystem::path& folder);

/// Removes what other attempts left of a job that has ended in jobs/FOLDER.
void remove_other_attempts(const std::filesystem::path& jobs, const std::string& folder);

}  // namespace sculpt::server
