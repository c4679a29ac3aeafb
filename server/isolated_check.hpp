// The check of a job whose files nobody has read yet, in a process of its own: a reader that a broken mesh makes crash,
// or go on for ever, takes nobody with it. Such readers are known (assimp 5.2 and .ply).
#pragma once

#include <chrono>
#include <mutex>
#include <set>
#include <string>

#include "server/job_description.hpp"
#include "server/planner.hpp"

namespace sculpt {

inline constexpr const char* check_job_option = "--check-job";

/// The files of jobs that passed. Safe from any thread.
class KnownFiles {
 public:
  /// Jobs with the same mesh, stock and uploaded cell have the same files. The cells of this server are the operator's.
  bool has(const JobSpec& spec) const;
  void add(const JobSpec& spec);

 private:
  static std::string files_of(const JobSpec& spec);

  mutable std::mutex mutex_;
  std::set<std::string> files_;
};

/// The daemon's side. Throws InputError as Planner::check does, and `mesh_unreadable` when the process dies or needs
/// longer than `patience`; Cancelled on a stop; std::system_error when there can be no process.
void check_in_child(const StoredSpec& stored, const Isolation& isolation, std::chrono::milliseconds patience,
                    const std::stop_token& stop);

/// The child's side: main of a program that was started with --check-job. Gives the exit code.
int run_isolated_check(const Planner& planner);

}  // namespace sculpt
