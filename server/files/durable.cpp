#include "server/files/durable.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sysexits.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>

#include "server/base/crash_point.hpp"
#include "server/base/storage_error.hpp"

namespace sculpt::server {

namespace fs = std::filesystem;

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

fs::path draft_of(const fs::path& file) {
  static const std::string mine = std::to_string(std::random_device{}());
  return file.string() + "." + mine + ".draft";
}

void write_durably(const fs::path& file, std::string_view bytes) {
  const fs::path draft = draft_of(file);
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

void remove_drafts_in(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".draft") fs::remove(entry.path(), ignored);
  }
}

}  // namespace sculpt::server
