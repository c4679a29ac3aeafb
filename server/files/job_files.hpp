// Where the files that jobs make are found: in a folder, or among those that a fleet shares. Then the folder is the
// daemon's own, for runs, and for what is made from results: any other daemon can make that too.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "server/files/stored_file.hpp"

namespace sculpt::server {

class SharedFiles;

/// Safe from any thread; all throw StorageError. `shared`, if there is one, outlives this.
class JobFiles {
 public:
  explicit JobFiles(std::filesystem::path folder, SharedFiles* shared = nullptr)
      : folder_(std::move(folder)), shared_(shared) {}

  const std::filesystem::path& folder() const { return folder_; }
  SharedFiles* shared() const { return shared_; }

  /// What a run wrote, or writes, as JOB_FOLDER/NAME; nothing where there is no such file.
  std::optional<StoredFile> open(const std::string& job_folder, const std::string& name) const;
  /// The same file is at folder()/JOB_FOLDER/NAME when this returns, if there is one: for programs that want a path.
  void fetch(const std::string& job_folder, const std::string& name) const;
  /// Tells the bytes of a job's files, as of now.
  std::function<std::uint64_t(const std::string& job)> sizes() const;
  /// Those that have left files, here or among the shared.
  std::set<std::string> jobs() const;
  /// Removes what is only a copy of a shared file, or made from one, of a job that has ended, and not written for so
  /// long. Nothing where there are no shared ones.
  void drop_copies(const std::string& job, std::chrono::seconds age) const;
  /// Removes what a job left, but for what `kept` (JOB/ATTEMPT, empty: nothing) has.
  void remove(const std::string& job, const std::string& kept = {}) const;

 private:
  std::filesystem::path folder_;
  SharedFiles* shared_;
};

/// What a file of a job's folder is called among those that a fleet shares.
std::string shared_path(const std::string& job_folder, const std::string& name);

}  // namespace sculpt::server
