// Finished jobs with milling tools -> the surface and the stocks that they leave, when first asked for.
#pragma once

#include <filesystem>
#include <stop_token>

#include "server/files/blobs.hpp"
#include "server/results/artifact_form.hpp"
#include "server/run/job_description.hpp"
#include "server/run/planner.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {

/// Safe from any thread.
class MachinedFiles {
 public:
  /// Both must outlive the object.
  MachinedFiles(const Blobs& blobs, const Isolation& isolation) : blobs_(blobs), isolation_(isolation) {}

  /// Makes a form whose origin is the job as `draft`, in a process of its own. The job's trajectory must be in its
  /// folder. Throws ProtocolError `wrong_state` for a job without milling tools, InputError as
  /// write_machined_surface, Cancelled, StorageError.
  void make(const JobRecord& job, const ArtifactForm& form, const std::filesystem::path& draft,
            const std::stop_token& stop) const;

 private:
  const Blobs& blobs_;
  const Isolation& isolation_;
};

inline constexpr const char* machined_job_option = "--machined-job";

/// The child's side: main of a program that was started with --machined-job. Gives the exit code.
int run_isolated_machined(const Planner& planner);

}  // namespace sculpt::server
