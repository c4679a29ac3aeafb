// Which files a thread may use, by Landlock (Linux 5.13 and later).
#pragma once

#include <filesystem>

namespace sculpt::server {

/// For the calling thread and those that it starts, for good: reading the running program and the files of `folder` (if
/// it is not empty), with `writes` also making, changing and removing them; nothing else can be opened, whoever the
/// user is. What is open stays so. Gives 0, or the errno with which the kernel refused. Needs PR_SET_NO_NEW_PRIVS.
int fence_files(const std::filesystem::path& folder, bool writes);

}  // namespace sculpt::server
