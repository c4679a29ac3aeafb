#include "server/results/exported_file.hpp"

#include <sstream>

#include "server/base/storage_error.hpp"
#include "server/files/durable.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_seal_bytes = 100;

std::string seal_name(const std::string& name) {
  return name + ".seal";
}

}  // namespace

std::optional<FileSeal> read_seal(const fs::path& folder, const std::string& job, const std::string& name) {
  const std::optional<StoredFile> written = StoredFile::open(folder, job, seal_name(name));
  if (!written || written->size() > max_seal_bytes) return std::nullopt;
  std::istringstream words(written->read(0, written->size()));
  FileSeal seal;
  words >> seal.size >> seal.sha256;
  const bool fits = words && fault_of_size(StoredFile::open(folder, job, name), seal).empty();
  return fits ? std::optional(seal) : std::nullopt;
}

void write_seal(const fs::path& folder, const std::string& job, const std::string& name) {
  const std::optional<StoredFile> file = StoredFile::open(folder, job, name);
  if (!file) throw StorageError("'" + (folder / job / name).string() + "' is gone");
  const FileSeal seal = file->seal();
  write_durably(folder / job / seal_name(name), std::to_string(seal.size) + " " + seal.sha256 + "\n");
}

void break_seal(const fs::path& folder, const std::string& job, const std::string& name) {
  std::error_code ignored;
  fs::remove(folder / job / seal_name(name), ignored);
}

}  // namespace sculpt::server
