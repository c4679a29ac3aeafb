// Which jobs passed their check, for ever: what was checked once is not read again for another job of the same files.
#pragma once

#include <filesystem>
#include <mutex>
#include <set>
#include <string>

#include "server/run/translate.hpp"

namespace sculpt::server {

/// Names all that a check depends on: the files by their content, what is to be made of them, the limits, and the
/// program that checks. Not the seed, the number of threads and the names of files. `cell_bundle` as in to_job.
std::string check_key(const proto::JobSpec& spec, const std::string& cell_bundle, const JobDefaults& defaults);

/// Kept in one file, a line for each; an entry that a crash took only costs another check. Safe from any thread.
class PassedChecks {
 public:
  /// Reads the file, if there is one.
  explicit PassedChecks(std::filesystem::path file);
  bool has(const std::string& key) const;
  /// Remembered also where the file cannot be written, until the daemon ends.
  void add(const std::string& key);

 private:
  std::filesystem::path file_;
  mutable std::mutex mutex_;
  std::set<std::string> keys_;
};

}  // namespace sculpt::server
