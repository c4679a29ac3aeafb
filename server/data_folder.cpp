#include "server/data_folder.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sysexits.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "server/crash_point.hpp"
#include "server/job_store.hpp"

namespace sculpt {

namespace fs = std::filesystem;

void remove_drafts_in(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".draft") fs::remove(entry.path(), ignored);
  }
}

namespace {

// A daemon that was killed leaves the files that it was writing: nothing refers to them.
void remove_drafts(const fs::path& blobs, const fs::path& jobs) {
  remove_drafts_in(blobs);
  std::error_code ignored;
  for (const fs::directory_entry& job : fs::directory_iterator(jobs, ignored)) remove_drafts_in(job.path());
}

// The lock is given back at once: the runs of this daemon take it.
void await_runs(const fs::path& jobs) {
  const int folder = ::open(jobs.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (::flock(folder, LOCK_EX | LOCK_NB) != 0) {
    spdlog::info("waits for the end of a process that the last daemon ran a job in");
    while (::flock(folder, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ::close(folder);
}

}  // namespace

DataFolder::DataFolder(const fs::path& folder) : folder_(folder) {
  std::error_code error;
  for (const fs::path& needed : {folder_, blobs(), jobs()}) {
    fs::create_directories(needed, error);
    if (error) {
      throw DataFolderError("cannot create the folder '" + needed.string() + "': " + error.message() +
                            "; name another with --data");
    }
  }
  const std::string lock_file = folder_ / "lock";
  lock_ = ::open(lock_file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) {
    throw DataFolderError("cannot write to the data folder '" + folder_.string() + "': " + std::strerror(errno) +
                          "; change its rights or name another with --data");
  }
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock_);
    throw DataFolderError("another sculptd uses the data folder '" + folder_.string() +
                          "': stop it or name another with --data");
  }
  await_runs(jobs());
  remove_drafts(blobs(), jobs());
}

DataFolder::~DataFolder() {
  ::close(lock_);
}

void hold_until_exit(const fs::path& jobs) {
  const int folder = ::open(jobs.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0 || ::flock(folder, LOCK_SH) != 0) fail_to_store(errno, "cannot lock '" + jobs.string() + "'");
}

void fail_to_store(int error, const std::string& what) {
  const std::string sentence = what + ": " + std::strerror(error);
  if (error == ENOSPC || error == EDQUOT) throw StorageFull(sentence + ": make space, then try again");
  throw StorageError(sentence);
}

void sync_to_disk(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = file >= 0 && ::fsync(file) == 0;
  const int error = errno;
  if (file >= 0) ::close(file);
  if (!done && error == EIO) end_after_failed_sync(path.string());
  if (!done) fail_to_store(error, "cannot make '" + path.string() + "' durable");
}

void end_after_failed_sync(const std::string& what) {
  spdlog::critical(
      "the disk failed to sync {}: the daemon ends at once, since nobody knows now what is on disk; what was "
      "acknowledged was synced before. Check the disk, then start it again",
      what);
  spdlog::shutdown();
  std::_Exit(EX_IOERR);
}

void write_durably(const fs::path& file, std::string_view bytes) {
  const fs::path draft = file.string() + ".draft";
  std::ofstream out(draft, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw StorageError("cannot write '" + draft.string() + "': check the free space");
  crash_point(CrashPoint::draft_written);
  sync_to_disk(draft);
  crash_point(CrashPoint::draft_synced);
  std::error_code error;
  fs::rename(draft, file, error);
  if (error) throw StorageError("cannot rename to '" + file.string() + "': " + error.message());
  crash_point(CrashPoint::draft_renamed);
  sync_to_disk(file.parent_path());
}

}  // namespace sculpt
