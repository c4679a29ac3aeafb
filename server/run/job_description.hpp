// What a process of its own is told of the job that it is to check, run or replay: one line of JSON on its standard
// input.
#pragma once

#include <chrono>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "server/run/translate.hpp"
#include "server/store/job_record.hpp"

namespace sculpt::server {

/// Where such processes come from and what they work on.
struct Isolation {
  std::filesystem::path worker;  ///< the program to start
  std::filesystem::path blobs, jobs;
  JobDefaults defaults;
  std::chrono::milliseconds cancel_grace{10000};  ///< a child that was asked to stop is killed after so long
  /// What is made of a finished job, such as a time law or a program, takes so long at most.
  std::chrono::milliseconds result_time{600000};
  std::filesystem::path held{};  ///< what such a process holds until it ends (folder_lock.hpp); empty: `jobs`
};

/// Of the record of a job.
struct StoredSpec {
  std::string spec, cell_bundle;
  std::string job = {};     ///< its id, if it has one yet
  std::int64_t time_s = 0;  ///< each of its threads may compute so long; 0: no limit
  std::string inherited = {};
  std::string folder = {};  ///< of its files, among those of all jobs
  Json asked = nullptr;     ///< what else a process is told that answers a question about it
};
std::string describe(const StoredSpec& stored, const Isolation& isolation);

struct DescribedJob {
  JobRecord job;  ///< id, spec, cell_bundle, inherited and folder
  Json asked;     ///< StoredSpec::asked
  std::int64_t time_s = 0;
  std::filesystem::path blobs, jobs;
  JobDefaults defaults;

  std::filesystem::path folder() const { return jobs / job.folder; }
};

/// The child's side: ties this process to its parent and reads what the parent has written. Also holds
/// Isolation::held until this process ends. Nothing when the parent died before it had said all: then there is
/// nothing to do and nobody to tell.
std::optional<DescribedJob> take_description(std::istream& in);

/// What of its one folder a process may use.
enum class FolderUse { none, read, write };

/// The child's side, before it starts a thread: reads the files of the job, as bytes, and then confines this process
/// (confinement.hpp) to what is left to do with them. Throws ProtocolError and StorageError.
Job load_and_confine(const DescribedJob& described, FolderUse use);

/// The same with the files of a cell alone, which may use no folder.
CellFiles load_cell_and_confine(const DescribedJob& described);

}  // namespace sculpt::server
