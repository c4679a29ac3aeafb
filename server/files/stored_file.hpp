// A file of the data folder, open for reading. Symbolic links are not followed: what is linked is not what was stored.
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

class StoredFile {
 public:
  /// FOLDER/JOB/NAME; nothing where there is no such regular file, or JOB (a name, or several) or NAME is a link.
  static std::optional<StoredFile> open(const std::filesystem::path& folder, const std::string& job,
                                        const std::string& name);
  StoredFile(StoredFile&& other) noexcept;
  StoredFile& operator=(StoredFile&&) = delete;
  ~StoredFile();

  /// Bytes, now.
  std::uint64_t size() const;
  /// Exactly so many. Throws StorageError.
  std::string read(std::uint64_t offset, std::uint64_t bytes) const;
  /// Of the whole. Throws StorageError.
  FileSeal seal() const;

 private:
  explicit StoredFile(int file) : file_(file) {}
  int file_;
};

/// What is wrong with the file by its size, or nothing.
std::string fault_of_size(const std::optional<StoredFile>& file, const FileSeal& seal);
/// The same, of its bytes too. Throws StorageError.
std::string fault_of(const std::optional<StoredFile>& file, const FileSeal& seal);

}  // namespace sculpt::server
