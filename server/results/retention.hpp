// What finished jobs leave behind is kept for a while: by age and by size, pinned jobs for ever.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "server/files/blobs.hpp"
#include "server/results/artifacts.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

struct RetentionRules {
  std::chrono::milliseconds age;  ///< since the end of the job
  std::uint64_t bytes;            ///< of all finished jobs; the oldest go first
  std::chrono::seconds blob_age =
      std::chrono::hours(24);  ///< a blob that no job needs stays for so long since its last use
};

/// Belongs to one thread at a time, the one of Blobs::put. The row of a job goes first, then its files: a crash between
/// the two leaves a folder without a job, which the next sweep removes; the other way round it would leave a job whose
/// results are lost.
class Retention {
 public:
  Retention(JobStore& store, Blobs& blobs, const Artifacts& artifacts)
      : store_(store), blobs_(blobs), artifacts_(artifacts) {}

  /// Removes what is due at `now_ms`: jobs, then folders and blobs that nobody needs. Gives the jobs that are gone.
  /// Throws StorageError.
  std::vector<std::string> sweep(const RetentionRules& rules, std::uint64_t now_ms);
  /// Removes what this daemon alone keeps of files that a fleet shares; nothing where files are in a folder.
  void drop_copies(const RetentionRules& rules);

 private:
  const JobFiles& files() const { return artifacts_.files(); }
  std::vector<std::string> remove_jobs(const RetentionRules& rules, std::uint64_t now_ms);
  void remove_leftovers();
  std::set<std::string> needed_blobs();

  JobStore& store_;
  Blobs& blobs_;
  const Artifacts& artifacts_;
};

}  // namespace sculpt::server
