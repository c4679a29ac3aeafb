#include "server/files/blobs.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "core/base/sha256.hpp"
#include "proto/error_codes.hpp"
#include "server/base/crash_point.hpp"
#include "server/base/storage_error.hpp"
#include "server/files/durable.hpp"
#include "server/files/shared_files.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t read_bytes = 1 << 20;

void write_at(const fs::path& path, std::uint64_t offset, std::string_view bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  bool fine = file >= 0;
  while (fine && !bytes.empty()) {
    const ssize_t written = ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    fine = written > 0;
    if (fine) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
      offset += static_cast<std::uint64_t>(written);
    }
  }
  const int error = errno;
  if (file >= 0) ::close(file);
  if (!fine) fail_to_store(error, "cannot write '" + path.string() + "'");
}

// Of a file that is not there: none.
std::uint64_t size_of(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

std::string file_hash(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  Sha256 hash;
  std::vector<char> buffer(read_bytes);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0) {
    hash.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
  }
  return hash.hex();
}

void rename_durably(const fs::path& from, const fs::path& to) {
  sync_to_disk(from);
  crash_point(CrashPoint::blob_synced);
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (!error) fs::rename(from, to, error);
  if (error) throw StorageError("cannot store the blob '" + to.string() + "': " + error.message());
  crash_point(CrashPoint::blob_renamed);
  sync_to_disk(to.parent_path());
  sync_to_disk(to.parent_path().parent_path());
}

}  // namespace

std::string shared_blob(const std::string& sha256) {
  return "blobs/" + sha256;
}

fs::path Blobs::place(const std::string& sha256) const {
  return folder_ / sha256.substr(0, 2) / sha256;
}

fs::path Blobs::part(const std::string& sha256, std::uint64_t size) const {
  return folder_ / (sha256 + "." + std::to_string(size) + ".part");
}

std::uint64_t Blobs::only_part_bytes(const std::string& sha256) const {
  std::vector<std::uint64_t> sizes;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
    if (entry.path().filename().string().starts_with(sha256 + ".") && entry.path().extension() == ".part")
      sizes.push_back(size_of(entry.path()));
  }
  return sizes.size() == 1 ? sizes.front() : 0;
}

BlobState Blobs::state(const std::string& sha256) const {
  std::error_code error;
  if (const std::uintmax_t size = fs::file_size(place(sha256), error); !error) return {size, true};
  return {only_part_bytes(sha256), false};
}

BlobState Blobs::use(const std::string& sha256) const {
  const auto use_here = [&] {
    const std::lock_guard lock(removal_);
    std::error_code ignored;
    fs::last_write_time(place(sha256), fs::file_time_type::clock::now(), ignored);
    return state(sha256);
  };
  const BlobState here = use_here();
  if (shared_ == nullptr) return here;
  if (here.complete) {
    share(sha256);
    return here;
  }
  return shared_->use(shared_blob(sha256)) && download(*shared_, shared_blob(sha256), place(sha256)) ? use_here()
                                                                                                     : here;
}

// Nothing to do where it is among the fleet's already.
void Blobs::share(const std::string& sha256) const {
  if (shared_ != nullptr) shared_->upload(place(sha256), shared_blob(sha256));
}

void Blobs::remove_unused(const std::set<std::string>& needed, std::chrono::seconds age) {
  const auto oldest = fs::file_time_type::clock::now() - age;
  std::vector<fs::path> unneeded;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_, error)) {
    std::error_code gone;
    if (entry.is_regular_file(gone) && !needed.contains(entry.path().filename())) unneeded.push_back(entry.path());
  }
  for (const fs::path& file : unneeded) {
    const std::lock_guard lock(removal_);
    // Opened, so that a network file system asks for the time that another machine may have set.
    const std::ifstream opened(file);
    const auto used = fs::last_write_time(file, error);
    if (!error && used < oldest) fs::remove(file, error);
  }
}

BlobState Blobs::put(const std::string& sha256, std::uint64_t size, std::uint64_t offset, std::string_view bytes) {
  if (const BlobState before = use(sha256); before.complete) return before;
  if (size > max_bytes_) {
    throw proto::ProtocolError("too_large",
                               "a blob of " + std::to_string(size) + " bytes is over this server's limit of " +
                                   std::to_string(max_bytes_) + ": send a smaller mesh or raise blob_limit_bytes",
                               "/params/size");
  }
  const fs::path file = part(sha256, size);
  const std::uint64_t before = size_of(file);
  if (offset > before) {
    throw proto::ProtocolError("offset_mismatch",
                               "the server has " + std::to_string(before) + " bytes of this blob, uploaded as one of " +
                                   std::to_string(size) + " bytes: go on there, not at " + std::to_string(offset),
                               "/params/offset");
  }
  write_at(file, offset, bytes);
  crash_point(CrashPoint::blob_written);
  const std::uint64_t have = std::max<std::uint64_t>(before, offset + bytes.size());
  if (have >= size) {
    complete(sha256, size);
    return {size, true};
  }
  return {have, false};
}

void Blobs::complete(const std::string& sha256, std::uint64_t size) {
  const fs::path file = part(sha256, size);
  std::error_code error;
  if (fs::file_size(file, error) != size || file_hash(file) != sha256) {
    fs::remove(file, error);
    throw proto::ProtocolError(
        "blob_mismatch", "the uploaded bytes do not have the hash " + sha256 + "; they were dropped: upload them again",
        "/params/sha256");
  }
  try {
    rename_durably(file, place(sha256));
  } catch (const StorageError&) {
    if (!state(sha256).complete) throw;  // another daemon that shares the folder was faster
  }
  share(sha256);
}

std::string Blobs::add(std::string_view bytes) {
  static std::atomic<std::uint64_t> drafts = 0;
  std::string sha256 = sha256_hex(bytes);
  if (use(sha256).complete) return sha256;
  const fs::path draft = draft_of(folder_ / (sha256 + "." + std::to_string(drafts++)));
  try {
    write_at(draft, 0, bytes);
    rename_durably(draft, place(sha256));
  } catch (...) {
    std::error_code ignored;
    fs::remove(draft, ignored);
    throw;
  }
  share(sha256);
  return sha256;
}

std::uint64_t Blobs::size(const std::string& sha256, const std::string& pointer) const {
  const BlobState blob = use(sha256);
  if (!blob.complete) {
    throw proto::ProtocolError(
        "blob_missing", "the blob " + sha256 + " is not (completely) uploaded: send it with blob.put first", pointer);
  }
  return blob.have;
}

std::string Blobs::read(const std::string& sha256, const std::string& pointer) const {
  return read_piece(sha256, 0, size(sha256, pointer));
}

std::string Blobs::read_piece(const std::string& sha256, std::uint64_t offset, std::size_t bytes) const {
  const std::uint64_t all = size(sha256, {});
  std::string piece(std::min<std::uint64_t>(bytes, all - std::min(all, offset)), '\0');
  std::ifstream in(place(sha256), std::ios::binary);
  in.seekg(static_cast<std::streamoff>(offset));
  if (!in.read(piece.data(), static_cast<std::streamsize>(piece.size())))
    throw StorageError("cannot read the blob " + sha256);
  return piece;
}

}  // namespace sculpt::server
