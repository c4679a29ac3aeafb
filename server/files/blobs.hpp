// Files by content: blobs/ab/abcdef..., uploaded in pieces into blobs/HASH.SIZE.part. So nobody who lies about a size
// touches what another client has uploaded.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

namespace sculpt::server {

struct BlobState {
  std::uint64_t have = 0;  ///< bytes from the start
  bool complete = false;
};

class SharedFiles;

/// Where a fleet shares its files otherwise than by a folder (`shared`), this one holds copies: what is used is in
/// both. `put` and `remove_unused` belong to one thread; everything else may be called from any. Throws StorageError
/// where the disk fails.
class Blobs {
 public:
  Blobs(std::filesystem::path folder, std::uint64_t max_bytes, SharedFiles* shared = nullptr)
      : folder_(std::move(folder)), max_bytes_(max_bytes), shared_(shared) {}

  const std::filesystem::path& folder() const { return folder_; }
  /// Of an upload: the only one there is, of whatever size; nothing where there are several.
  BlobState state(const std::string& sha256) const;
  /// The same, of the fleet's; the blob counts as used now, as by `put`, `add` and `read`, and is here.
  BlobState use(const std::string& sha256) const;
  /// Adds a piece; when the last byte is there the hash is checked and the blob becomes durable. Throws ProtocolError
  /// `too_large`, `offset_mismatch`, `blob_mismatch` (what was uploaded is dropped).
  BlobState put(const std::string& sha256, std::uint64_t size, std::uint64_t offset, std::string_view bytes);
  /// Removes blobs, and pieces of blobs, that are not in `needed` and were not used for so long: the copies here.
  void remove_unused(const std::set<std::string>& needed, std::chrono::seconds age);
  /// Stores content made here and returns its hash.
  std::string add(std::string_view bytes);
  // All throw ProtocolError `blob_missing`, with `pointer`; the blob counts as used now.
  std::uint64_t size(const std::string& sha256, const std::string& pointer) const;
  std::string read(const std::string& sha256, const std::string& pointer) const;
  /// Of it as many bytes from `offset` on as there are, `bytes` at most.
  std::string read_piece(const std::string& sha256, std::uint64_t offset, std::size_t bytes) const;

 private:
  std::filesystem::path place(const std::string& sha256) const;
  std::filesystem::path part(const std::string& sha256, std::uint64_t size) const;
  std::uint64_t only_part_bytes(const std::string& sha256) const;
  void complete(const std::string& sha256, std::uint64_t size);
  void share(const std::string& sha256) const;

  std::filesystem::path folder_;
  std::uint64_t max_bytes_;
  SharedFiles* shared_;
  mutable std::mutex removal_;  ///< a blob is used, or found unused and removed
};

/// What a blob is called among the files that a fleet shares.
std::string shared_blob(const std::string& sha256);

}  // namespace sculpt::server
