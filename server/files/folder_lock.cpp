#include "server/files/folder_lock.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "server/files/durable.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds pause{5};

bool lock_in_time(int file, std::chrono::milliseconds patience) {
  const auto end = Clock::now() + patience;
  while (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, std::chrono::milliseconds patience) {
  file_ = ::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (file_ < 0) {
    throw DataFolderError("cannot write to the data folder '" + folder.string() + "': " + std::strerror(errno) +
                          "; change its rights or name another with --data");
  }
  if (!lock_in_time(file_, patience)) {
    ::close(file_);
    throw DataFolderError("another sculptd uses the data folder '" + folder.string() +
                          "': stop it or name another with --data");
  }
}

FolderLock::~FolderLock() {
  ::close(file_);
}

void hold_until_exit(const fs::path& jobs) {
  const int folder = ::open(jobs.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0 || ::flock(folder, LOCK_SH) != 0) fail_to_store(errno, "cannot lock '" + jobs.string() + "'");
}

// The lock is given back at once: the runs of the next daemon take it.
void await_runs(const fs::path& jobs) {
  const int folder = ::open(jobs.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  if (::flock(folder, LOCK_EX | LOCK_NB) != 0) {
    spdlog::info("waits for the end of a process that the last daemon ran a job in");
    while (::flock(folder, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ::close(folder);
}

}  // namespace sculpt::server
