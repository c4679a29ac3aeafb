// Finished jobs -> their robot programs, each packed into one .zip when it is first asked for. The last few of a job
// are kept beside its results and go with them.
#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "proto/motion/program_spec.hpp"
#include "server/files/blobs.hpp"
#include "server/run/job_description.hpp"

namespace sculpt::server {

/// Which name such a file has in the folder of its job: another one for another spec.
std::string program_file(const proto::ProgramSpec& spec);

/// Safe from any thread.
class Programs {
 public:
  /// Both must outlive the object.
  Programs(const Blobs& blobs, const Isolation& isolation) : blobs_(blobs), isolation_(isolation) {}

  /// Makes the .zip as `draft`, in a process of its own. The job's trajectory must be in its folder. Throws
  /// ProtocolError `wrong_state` where the plan must not be run, InputError as make_program, Cancelled, StorageError.
  void make(const JobRecord& job, const proto::ProgramSpec& spec, const std::filesystem::path& draft,
            const std::stop_token& stop) const;
  /// Call when the file of a spec is there as a whole: writes its spec beside it, and removes the oldest of the job
  /// where there are more than are kept. Throws StorageError.
  void keep(const std::filesystem::path& folder, const proto::ProgramSpec& spec) const;

 private:
  const Blobs& blobs_;
  const Isolation& isolation_;
};

/// Names of the files of those that are there, whole or not.
std::vector<std::string> program_files(const std::filesystem::path& folder, const std::string& job_folder);

/// Those that are there: `[{format,size,sha256,program}]`, in no order that means anything but always the same.
Json list_programs(const std::filesystem::path& folder, const std::string& job_folder);

/// Throws ProtocolError `wrong_state` for a job whose plan has failed its replay.
void check_may_run(const JobRecord& job);

}  // namespace sculpt::server
