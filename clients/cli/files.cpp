#include "clients/cli/files.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "clients/cli/exit_code.hpp"

namespace sculpt::cli {

namespace fs = std::filesystem;

fs::path cache_folder() {
  if (const char* named = std::getenv("SCULPT_CACHE")) return named;
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
    return fs::path(cache) / "sculpt";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') return fs::path(home) / ".cache/sculpt";
  return {};
}

std::string read_input(const fs::path& path, const std::string& what) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw Failure(exit_usage, "file_missing", "no " + what + " file " + path.string() + ": check the path");
  if (fs::is_directory(path, ignored))
    throw Failure(exit_usage, "file_unreadable", path.string() + " is a folder: name the " + what + " file in it");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  if (in && in.peek() != std::ifstream::traits_type::eof()) bytes << in.rdbuf();
  if (!in.is_open() || in.bad() || bytes.bad())
    throw Failure(exit_usage, "file_unreadable",
                  "cannot read the " + what + " file " + path.string() + " (" + std::strerror(errno) +
                      "): check its permissions");
  return std::move(bytes).str();
}

PartFile::PartFile(fs::path path) : path_(std::move(path)), part_(path_.string() + ".part") {
  stream_.open(part_, std::ios::binary | std::ios::trunc);
  if (!stream_)
    throw Failure(
        exit_usage, "file_unwritable",
        "cannot write " + part_.string() + " (" + std::strerror(errno) + "): check the folder, or choose another -o");
}

PartFile::~PartFile() {
  stream_.close();
  std::error_code ignored;
  fs::remove(part_, ignored);
}

void PartFile::finish() {
  stream_.close();
  std::error_code failed;
  if (!stream_.fail()) fs::rename(part_, path_, failed);
  if (stream_.fail() || failed)
    throw Failure(
        exit_usage, "file_unwritable",
        "cannot complete " + path_.string() + " (" + std::strerror(errno) + "): check the space left on the disk");
}

}  // namespace sculpt::cli
