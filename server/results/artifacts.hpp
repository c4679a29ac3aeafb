// The files that a job makes: its trajectory and timeline grow while it runs, the others come at the end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/sha256.hpp"
#include "proto/messages.hpp"
#include "server/files/job_files.hpp"
#include "server/results/artifact_form.hpp"
#include "server/results/machined_files.hpp"
#include "server/results/programs.hpp"
#include "server/run/planner.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

struct ArtifactChunk {
  std::string format;
  std::string bytes;
  std::uint64_t size = 0;  ///< of the artifact, now
  bool final = false;      ///< it will not grow any more
  std::string sha256;      ///< of the whole, when it is final
};

/// One reader's way through an artifact, piece by piece. Read from its first byte to its last it is held against its
/// hash; who begins elsewhere, or leaps, has to do that himself.
struct WholeRead {
  std::string job, file;
  std::uint64_t next = 0;
  Sha256 hash;
};

/// Safe from any thread, but `make_export` belongs to one.
class Artifacts {
 public:
  /// What it refers to must outlive it.
  Artifacts(JobFiles files, JobStore& store, const Planner& planner, const Programs& programs,
            const MachinedFiles& machined)
      : files_(std::move(files)), store_(store), planner_(planner), programs_(programs), machined_(machined) {}

  const JobFiles& files() const { return files_; }

  /// Removes the files of a job that has ended without artifacts, or was removed; those of one that the store has never
  /// known are put aside (orphans.hpp).
  void discard_leftovers(const std::string& job) const;

  /// The names and formats in the order of PROTOCOL.md; of an artifact that is not there yet size 0 and no hash.
  Json list(const JobRecord& job) const;
  /// Throws ProtocolError `params_invalid` (unknown artifact or format), `wrong_state` (not there, and why),
  /// `artifact_damaged` (another size than it was stored with, or the last piece of other bytes): the job says so from
  /// then on.
  ArtifactChunk read(const proto::ArtifactReadParams& wanted, WholeRead& so_far) const;
  /// True when `read` needs make_export first.
  bool needs_export(const proto::ArtifactReadParams& wanted) const;
  /// Makes another form from the final artifact's own, or one of the trajectory. Throws as read, and as Programs::make
  /// and MachinedFiles::make.
  void make_export(const proto::ArtifactReadParams& wanted, const std::stop_token& stop) const;
  /// The final content of an artifact in its own format. Throws ProtocolError `wrong_state`, `artifact_damaged`.
  std::string read_whole(const JobRecord& job, const std::string& artifact) const;
  /// Its file is the one that was stored, and at files().folder(), under its name, for programs that want a path.
  /// Throws as read_whole.
  void check_whole(const JobRecord& job, const std::string& artifact) const;

 private:
  std::optional<FileSeal> seal_of(const JobRecord& job, const ArtifactForm& form) const;
  std::optional<StoredFile> open(const JobRecord& job, const ArtifactForm& form) const;
  void follow(const JobRecord& job, const proto::ArtifactReadParams& wanted, const ArtifactChunk& chunk,
              WholeRead& so_far) const;
  [[noreturn]] void refuse_damaged(const JobRecord& record, const ArtifactForm& form, const std::string& fault) const;

  const std::filesystem::path& folder() const { return files_.folder(); }

  JobFiles files_;
  JobStore& store_;
  const Planner& planner_;
  const Programs& programs_;
  const MachinedFiles& machined_;
};

}  // namespace sculpt::server
