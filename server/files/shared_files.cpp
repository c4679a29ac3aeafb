#include "server/files/shared_files.hpp"

#include <atomic>
#include <cerrno>
#include <fstream>

#include "server/base/storage_error.hpp"
#include "server/files/durable.hpp"

namespace sculpt::server {

namespace fs = std::filesystem;

bool download(SharedFiles& files, const std::string& path, const fs::path& to) {
  static std::atomic<std::uint64_t> drafts = 0;
  const std::optional<std::uint64_t> size = files.size(path);
  if (!size) return false;
  fs::create_directories(to.parent_path());
  const fs::path draft = draft_of(to.string() + "." + std::to_string(drafts++));
  try {
    std::ofstream out(draft, std::ios::binary | std::ios::trunc);
    for (std::uint64_t offset = 0; offset < *size;) {
      const std::string piece = files.read(path, offset, std::min(shared_piece_bytes, *size - offset));
      if (piece.empty()) throw StorageError("'" + path + "' became shorter while it was read: try again");
      out.write(piece.data(), static_cast<std::streamsize>(piece.size()));
      offset += piece.size();
    }
    out.close();
    if (!out) fail_to_store(errno, "cannot write '" + draft.string() + "'");
    sync_to_disk(draft);
    fs::rename(draft, to);
    sync_to_disk(to.parent_path());
  } catch (...) {
    std::error_code ignored;
    fs::remove(draft, ignored);
    throw;
  }
  return true;
}

}  // namespace sculpt::server
