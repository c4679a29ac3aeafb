// The folder that belongs to one daemon: sculptd.db, sculptd.mark, blobs/, jobs/ID/. Locked while the daemon lives.
#pragma once

#include <chrono>
#include <filesystem>

#include "server/files/folder_lock.hpp"

namespace sculpt::server {

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

}  // namespace sculpt::server
