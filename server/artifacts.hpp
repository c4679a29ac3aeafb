// The files that a job makes: jobs/ID/trajectory.ndjson grows while it runs, the others come at the end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "proto/messages.hpp"
#include "server/job_store.hpp"
#include "server/planner.hpp"

namespace sculpt {

struct ArtifactChunk {
  std::string format;
  std::string bytes;
  std::uint64_t size = 0;  ///< of the artifact, now
  bool final = false;      ///< it will not grow any more
};

/// Safe from any thread, but `make_export` belongs to one.
class Artifacts {
 public:
  Artifacts(std::filesystem::path folder, JobStore& store, const Planner& planner)
      : folder_(std::move(folder)), store_(store), planner_(planner) {}

  std::filesystem::path job_folder(const std::string& job) const { return folder_ / job; }
  std::filesystem::path trajectory(const std::string& job) const { return job_folder(job) / "trajectory.ndjson"; }

  /// Removes the files of a job that has ended without artifacts, or was removed.
  void discard_leftovers(const std::string& job) const;

  /// The names and formats in the order of PROTOCOL.md; of an artifact that is not there yet size 0 and no hash.
  Json list(const JobRecord& job) const;
  /// Throws ProtocolError `params_invalid` (unknown artifact or format), `wrong_state` (not there, and why).
  ArtifactChunk read(const ArtifactReadParams& wanted) const;
  /// True when `read` needs make_export first.
  bool needs_export(const ArtifactReadParams& wanted) const;
  /// Makes the trajectory's csv or binary from the final ndjson. Throws as read.
  void make_export(const ArtifactReadParams& wanted) const;
  /// The final content of an artifact in its own format. Throws ProtocolError `wrong_state`.
  std::string read_whole(const JobRecord& job, const std::string& artifact) const;

 private:
  std::filesystem::path folder_;
  JobStore& store_;
  const Planner& planner_;
};

}  // namespace sculpt
