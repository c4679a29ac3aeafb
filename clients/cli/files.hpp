// Files named on the command line: read whole, or written beside their final name and renamed when complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace sculpt::cli {

/// Throws Failure (usage) `file_missing` or `file_unreadable`; `what` names the thing in the sentence, e.g. "mesh".
std::string read_input(const std::filesystem::path& path, const std::string& what);

/// Where to keep what can be found out again: `sculpt` in the user's cache folder, or what the environment variable
/// SCULPT_CACHE names; empty: nowhere.
std::filesystem::path cache_folder();

/// An output file that never shows a half: bytes go to `FILE.part`, `finish` renames it. Without `finish` nothing stays
/// behind. Throws Failure (usage) `file_unwritable`.
class PartFile {
 public:
  explicit PartFile(std::filesystem::path path);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Where the bytes go; open for writing from the start.
  const std::filesystem::path& part() const { return part_; }
  std::ofstream& stream() { return stream_; }
  void finish();

 private:
  std::filesystem::path path_, part_;
  std::ofstream stream_;
};

}  // namespace sculpt::cli
