#include "server/files/data_folder.hpp"

#include <spdlog/spdlog.h>

#include "server/files/durable.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

// A daemon that was killed leaves the files that it was writing: nothing refers to them.
void remove_drafts(const fs::path& blobs, const fs::path& jobs) {
  remove_drafts_in(blobs);
  std::error_code ignored;
  for (const fs::directory_entry& job : fs::directory_iterator(jobs, ignored)) remove_drafts_in(job.path());
}

fs::path make_folders(const fs::path& folder) {
  std::error_code error;
  for (const fs::path& needed : {folder, folder / "blobs", folder / "jobs"}) {
    fs::create_directories(needed, error);
    if (error) {
      throw DataFolderError("cannot create the folder '" + needed.string() + "': " + error.message() +
                            "; name another with --data");
    }
  }
  // Also what an older version made readable: meshes and plans are nobody else's business.
  fs::permissions(folder, fs::perms::owner_all, error);
  if (error) spdlog::warn("the data folder '{}' cannot be closed to others: {}", folder.string(), error.message());
  return folder;
}

}  // namespace

DataFolder::DataFolder(const fs::path& data, std::chrono::milliseconds patience)
    : FolderPaths{make_folders(data)}, lock_(folder, patience) {
  await_runs(jobs());
  remove_drafts_in(folder);
  remove_drafts(blobs(), jobs());
}

}  // namespace sculpt::server
