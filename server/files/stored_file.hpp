// A file of the data folder, or one that a fleet shares, open for reading. Symbolic links are not followed: what is
// linked is not what was stored.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace sculpt::server {

/// What a file must be.
struct FileSeal {
  std::uint64_t size = 0;
  std::string sha256;
};

class SharedFiles;

class StoredFile {
 public:
  /// FOLDER/JOB/NAME; nothing where there is no such regular file, or JOB (a name, or several) or NAME is a link.
  static std::optional<StoredFile> open(const std::filesystem::path& folder, const std::string& job,
                                        const std::string& name);
  /// Nothing where there is none. Refers to `files`. Throws StorageError.
  static std::optional<StoredFile> open(SharedFiles& files, const std::string& path);
  StoredFile(StoredFile&& other) noexcept;
  StoredFile& operator=(StoredFile&&) = delete;
  ~StoredFile();

  /// Bytes, now; of a shared file, when it was opened.
  std::uint64_t size() const;
  /// Exactly so many. Throws StorageError.
  std::string read(std::uint64_t offset, std::uint64_t bytes) const;
  /// Of the whole. Throws StorageError.
  FileSeal seal() const;

 private:
  explicit StoredFile(int file) : file_(file) {}
  StoredFile(SharedFiles& files, std::string path, std::uint64_t size)
      : shared_(&files), path_(std::move(path)), size_(size) {}
  std::string read_shared(std::uint64_t offset, std::uint64_t bytes) const;

  int file_ = -1;
  SharedFiles* shared_ = nullptr;
  std::string path_;
  std::uint64_t size_ = 0;  // when it was opened, of one that is shared
};

/// What is wrong with the file by its size, or nothing.
std::string fault_of_size(const std::optional<StoredFile>& file, const FileSeal& seal);
/// The same, of its bytes too. Throws StorageError.
std::string fault_of(const std::optional<StoredFile>& file, const FileSeal& seal);

}  // namespace sculpt::server
