#include "server/files/stored_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "core/base/sha256.hpp"
#include "server/base/storage_error.hpp"
#include "server/files/durable.hpp"
#include "server/files/shared_files.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t hashed_piece_bytes = 1 << 20;

bool is_regular(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

// Each name on the way from the folder is no link. -1: there is none.
int open_folder(const fs::path& folder, const fs::path& way) {
  constexpr int flags = O_PATH | O_DIRECTORY | O_CLOEXEC;
  int at = ::open(folder.c_str(), flags);
  for (const fs::path& name : way) {
    const int next = at < 0 ? -1 : ::openat(at, name.c_str(), flags | O_NOFOLLOW);
    if (at >= 0) ::close(at);
    at = next;
  }
  return at;
}

}  // namespace

std::optional<StoredFile> StoredFile::open(const fs::path& folder, const std::string& job, const std::string& name) {
  const int inside = open_folder(folder, job);
  if (inside < 0) return std::nullopt;
  const int opened = ::openat(inside, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  const int error = errno;
  ::close(inside);
  if (opened < 0 && (error == EMFILE || error == ENFILE || error == EIO)) {
    fail_to_store(error, "cannot read '" + (folder / job / name).string() + "'");
  }
  if (opened < 0) return std::nullopt;
  StoredFile file(opened);
  return is_regular(opened) ? std::optional(std::move(file)) : std::nullopt;
}

std::optional<StoredFile> StoredFile::open(SharedFiles& files, const std::string& path) {
  const std::optional<std::uint64_t> size = files.size(path);
  return size ? std::optional(StoredFile(files, path, *size)) : std::nullopt;
}

StoredFile::StoredFile(StoredFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      shared_(other.shared_),
      path_(std::move(other.path_)),
      size_(other.size_) {}

StoredFile::~StoredFile() {
  if (file_ >= 0) ::close(file_);
}

std::uint64_t StoredFile::size() const {
  if (shared_ != nullptr) return size_;
  struct stat status {};
  return ::fstat(file_, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::string StoredFile::read(std::uint64_t offset, std::uint64_t bytes) const {
  if (shared_ != nullptr) return read_shared(offset, bytes);
  std::string part(bytes, '\0');
  for (std::uint64_t done = 0; done < bytes;) {
    const ssize_t got = ::pread(file_, part.data() + done, bytes - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_to_store(errno, "cannot read an artifact");
    if (got == 0) throw StorageError("an artifact became shorter while it was read");
    done += static_cast<std::uint64_t>(got);
  }
  return part;
}

std::string StoredFile::read_shared(std::uint64_t offset, std::uint64_t bytes) const {
  std::string part;
  while (part.size() < bytes) {
    const std::string piece = shared_->read(path_, offset + part.size(), bytes - part.size());
    if (piece.empty()) throw StorageError("an artifact became shorter while it was read");
    part += piece;
  }
  return part;
}

FileSeal StoredFile::seal() const {
  Sha256 hash;
  const std::uint64_t all = size();
  for (std::uint64_t offset = 0; offset < all; offset += hashed_piece_bytes)
    hash.add(read(offset, std::min(hashed_piece_bytes, all - offset)));
  return {all, hash.hex()};
}

std::string fault_of_size(const std::optional<StoredFile>& file, const FileSeal& seal) {
  if (!file) return "is missing, or no file";
  if (file->size() == seal.size) return {};
  return "has " + std::to_string(file->size()) + " bytes, not " + std::to_string(seal.size);
}

std::string fault_of(const std::optional<StoredFile>& file, const FileSeal& seal) {
  const std::string fault = fault_of_size(file, seal);
  if (!fault.empty()) return fault;
  return file->seal().sha256 == seal.sha256 ? "" : "has other bytes than were stored";
}

}  // namespace sculpt::server
