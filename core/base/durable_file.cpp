#include "core/base/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/base/error.hpp"

namespace sculpt {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw InputError("file_unwritable",
                   "cannot write '" + path.string() + "'" + why + ": check the folder, its rights and the free space");
}

}  // namespace

void sync_file(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = file >= 0 && ::fsync(file) == 0;
  const int error = errno;
  if (file >= 0) ::close(file);
  if (!done && error == EIO) throw SyncError(path.string());
  if (!done) refuse(path, std::string(" (") + std::strerror(error) + ")");
}

void start_sync(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  ::sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE);
  ::close(file);
}

void replace_file(const fs::path& file, std::string_view bytes) {
  const fs::path draft = file.string() + ".draft";
  std::ofstream out(draft, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) refuse(draft, "");
  sync_file(draft);
  std::error_code error;
  fs::rename(draft, file, error);
  if (error) refuse(file, " (" + error.message() + ")");
  sync_file(file.parent_path());
}

}  // namespace sculpt
