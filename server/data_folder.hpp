// The folder that belongs to one daemon: sculptd.db, sculptd.mark, blobs/, jobs/ID/. Locked while the daemon lives.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

#include "server/folder_lock.hpp"

namespace sculpt {

struct FolderPaths {
  std::filesystem::path folder;

  std::filesystem::path database() const { return folder / "sculptd.db"; }
  /// What the database is held against at the start (store_mark.hpp).
  std::filesystem::path mark() const { return folder / "sculptd.mark"; }
  std::filesystem::path blobs() const { return folder / "blobs"; }
  std::filesystem::path jobs() const { return folder / "jobs"; }
};

class DataFolder : public FolderPaths {
 public:
  /// Creates what is missing, takes the lock, waits for the end of hold_until_exit and removes drafts. Throws
  /// DataFolderError (no rights, or another daemon has it for longer than `patience`).
  explicit DataFolder(const std::filesystem::path& data, std::chrono::milliseconds patience = std::chrono::seconds(2));

 private:
  FolderLock lock_;
};

/// A sync failed with EIO: the kernel may have dropped what it held, and a second try would hide that. Logs, and ends
/// the process with EX_IOERR: everything acknowledged is on disk, and the next daemon reads it from there. Any thread.
[[noreturn]] void end_after_failed_sync(const std::string& what);

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
