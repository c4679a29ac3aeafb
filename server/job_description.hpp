// What a process of its own is told of the job that it is to run or to check: one line of JSON on its standard input.
#pragma once

#include <chrono>
#include <filesystem>
#include <iosfwd>
#include <string>

#include "server/job_record.hpp"
#include "server/translate.hpp"

namespace sculpt {

/// Where such processes come from and what they work on.
struct Isolation {
  std::filesystem::path worker;  ///< the program to start
  std::filesystem::path blobs, jobs;
  JobDefaults defaults;
  std::chrono::milliseconds cancel_grace{10000};  ///< a child that was asked to stop is killed after so long
};

/// Of the record of a job.
struct StoredSpec {
  std::string spec, cell_bundle;
  std::string job = {};  ///< its id, if it has one yet
};
std::string describe(const StoredSpec& stored, const Isolation& isolation);

struct DescribedJob {
  JobRecord job;  ///< id, spec and cell_bundle
  std::filesystem::path blobs, jobs;
  JobDefaults defaults;
};

/// The child's side: ties this process to its parent and reads what the parent has written. Also holds the jobs folder
/// until this process ends (data_folder.hpp).
DescribedJob take_description(std::istream& in);

}  // namespace sculpt
