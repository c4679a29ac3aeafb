// Files that every daemon of a fleet can read where they have no folder in common. Each is known by the path that it
// would have in such a folder: blobs/HASH, jobs/ID/ATTEMPT/NAME.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace sculpt::server {

/// The most that is stored or given in one piece; longer files are made of several.
inline constexpr std::uint64_t shared_piece_bytes = 1 << 20;

/// Safe from any thread. Every method throws StorageError, DatabaseUnavailable where a later try may help. What a
/// method has stored is durable when it returns.
class SharedFiles {
 public:
  virtual ~SharedFiles() = default;

  /// Bytes, now; nothing where there is no such file.
  virtual std::optional<std::uint64_t> size(const std::string& path) = 0;
  /// So many bytes, fewer where the file ends; at most shared_piece_bytes.
  virtual std::string read(const std::string& path, std::uint64_t offset, std::uint64_t bytes) = 0;
  /// The files of a job by their paths, with their sizes.
  virtual std::map<std::string, std::uint64_t> files_of(const std::string& job) = 0;
  /// Bytes of all files of each job that has some.
  virtual std::map<std::string, std::uint64_t> bytes_of_jobs() = 0;

  /// Makes a file of a run, empty, unless it is there. False: the run has lost its job, and may make none.
  virtual bool make(const std::string& job, int attempt, const std::string& path) = 0;
  /// At its present end, which must be `offset`; at most shared_piece_bytes. Throws StorageError if it is not.
  virtual void append(const std::string& path, std::uint64_t offset, std::string_view bytes) = 0;
  /// The whole content of a file that is there; at most shared_piece_bytes.
  virtual void replace(const std::string& path, std::string_view bytes) = 0;
  virtual void remove(const std::set<std::string>& paths) = 0;

  /// A file of no job, whole or not at all; nothing to do where it is there.
  virtual void upload(const std::filesystem::path& from, const std::string& path) = 0;
  /// Its size, as of a file that is used now; nothing where there is none.
  virtual std::optional<std::uint64_t> use(const std::string& path) = 0;
  /// Removes the files of jobs that are gone, and those of no job that are not needed and were not used for so long.
  virtual void remove_unused(const std::set<std::string>& needed, std::chrono::seconds age) = 0;
};

/// Makes `to` a copy of a shared file, whole and durable, or nothing: false where there is no such file. Throws
/// StorageError.
bool download(SharedFiles& files, const std::string& path, const std::filesystem::path& to);

}  // namespace sculpt::server
