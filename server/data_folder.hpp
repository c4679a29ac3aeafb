// The folder that belongs to one daemon: sculptd.db, blobs/, jobs/ID/. Locked while the daemon lives.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sculpt {

/// The folder cannot be used; what() names it, the reason and the cure.
class DataFolderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class DataFolder {
 public:
  /// Creates what is missing, takes the lock and waits for the end of hold_until_exit. Throws DataFolderError (no
  /// rights, or another daemon has it).
  explicit DataFolder(const std::filesystem::path& folder);
  ~DataFolder();
  DataFolder(const DataFolder&) = delete;
  DataFolder& operator=(const DataFolder&) = delete;

  std::filesystem::path database() const { return folder_ / "sculptd.db"; }
  std::filesystem::path blobs() const { return folder_ / "blobs"; }
  std::filesystem::path jobs() const { return folder_ / "jobs"; }

 private:
  std::filesystem::path folder_;
  int lock_ = -1;
};

/// A sync failed with EIO: the kernel may have dropped what it held, and a second try would hide that. Logs, and ends
/// the process with EX_IOERR: everything acknowledged is on disk, and the next daemon reads it from there. Any thread.
[[noreturn]] void end_after_failed_sync(const std::string& what);

/// For a process that runs a job: the next daemon on the folder waits until this process has ended. A daemon that is
/// killed takes such a process with it, but not before a system call that it is in returns, and that may make a file.
/// Throws StorageError.
void hold_until_exit(const std::filesystem::path& jobs);

/// Throws StorageFull or StorageError, by the errno of a call that failed.
[[noreturn]] void fail_to_store(int error, const std::string& what);

// Both throw StorageError and end the process as above.
/// Makes a file's content durable, and a folder's entries.
void sync_to_disk(const std::filesystem::path& file_or_folder);
/// Writes a whole file so that it is there completely or not at all, also after a power cut.
void write_durably(const std::filesystem::path& file, std::string_view bytes);
/// Removes what a process that died left of files that it was writing as a whole, in this folder alone.
void remove_drafts_in(const std::filesystem::path& folder);

}  // namespace sculpt
