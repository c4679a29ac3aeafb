// The lock of a data folder: one program at a time writes there.
#pragma once

#include <chrono>
#include <filesystem>
#include <stdexcept>

namespace sculpt::server {

/// The folder cannot be used; what() names it, the reason and the cure.
class DataFolderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Held while it lives. What a daemon that was killed was about to start (between fork and exec) has a copy of its lock
/// for a moment: so one that is taken is looked at again for `patience`.
class FolderLock {
 public:
  /// Throws DataFolderError (no rights, or another daemon has it).
  explicit FolderLock(const std::filesystem::path& folder,
                      std::chrono::milliseconds patience = std::chrono::seconds(2));
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

/// For a process that runs a job: the next daemon on the folder waits until this process has ended. A daemon that is
/// killed takes such a process with it, but not before a system call that it is in returns, and that may make a file.
/// Throws StorageError.
void hold_until_exit(const std::filesystem::path& jobs);
/// Waits for the end of all processes that hold so. Call with the folder's lock.
void await_runs(const std::filesystem::path& jobs);

}  // namespace sculpt::server
