// Folders of jobs that the store does not know: never deleted, for they may be all that is left of a result.
#pragma once

#include <filesystem>
#include <string>

namespace sculpt::server {

/// Where they are put: jobs.orphaned beside jobs.
std::filesystem::path orphan_folder(const std::filesystem::path& jobs);

/// Moves jobs/NAME there, under a name of its own, and logs it. Gives its new place; nothing (an empty path) when it
/// cannot be moved, which is logged too.
std::filesystem::path put_aside(const std::filesystem::path& jobs, const std::string& name);

}  // namespace sculpt::server
