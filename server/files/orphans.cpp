#include "server/files/orphans.hpp"

#include <spdlog/spdlog.h>

namespace sculpt::server {

namespace fs = std::filesystem;

fs::path orphan_folder(const fs::path& jobs) {
  return jobs.parent_path() / "jobs.orphaned";
}

fs::path put_aside(const fs::path& jobs, const std::string& name) {
  std::error_code error;
  fs::create_directories(orphan_folder(jobs), error);
  fs::path place = orphan_folder(jobs) / name;
  for (int copy = 2; fs::exists(fs::symlink_status(place)); ++copy) {
    place = orphan_folder(jobs) / (name + "." + std::to_string(copy));
  }
  fs::rename(jobs / name, place, error);
  if (error) {
    spdlog::error("'{}' belongs to no job and cannot be put aside: {}", (jobs / name).string(), error.message());
    return {};
  }
  spdlog::warn("'{}' belongs to no job: it is now '{}', where nobody deletes it", (jobs / name).string(),
               place.string());
  return place;
}

}  // namespace sculpt::server
