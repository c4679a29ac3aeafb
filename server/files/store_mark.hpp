// sculptd.mark: which store belongs into the data folder and how much it has to know, beside the database that knows
// it.
//
// Two lines alike, written in turn, each with its own check: one that was cut by a fault leaves the other.
//   sculptd-mark 1 store 01J... changes 00000000000000000042 check 1a2b3c4d
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

namespace sculpt::server {

/// What is in the folder cannot be taken for the store that was there before; what() says what is missing and the
/// cures.
class StoreLost : public std::runtime_error {
 public:
  StoreLost(const std::string& fault, const std::string& cure)
      : std::runtime_error(fault + ": " + cure), fault_(fault), cure_(cure) {}
  const std::string& fault() const { return fault_; }
  const std::string& cure() const { return cure_; }

 private:
  std::string fault_, cure_;
};

/// The cure where something is left to go on with.
inline constexpr const char* restore_or_adopt =
    "restore a backup of the data folder, or run 'sculptd adopt' to go on with what is there";

struct Mark {
  std::string store;          ///< the epoch of the database
  std::uint64_t changes = 0;  ///< that the database has at least (SqliteRows::changes)
};

/// Nothing where there is no file. Throws StoreLost for one that cannot be read.
std::optional<Mark> read_mark(const std::filesystem::path& file);
/// Durably, in the place of an older one. Throws StorageError.
void write_mark(const std::filesystem::path& file, const Mark& mark);

/// Raises the mark after each commit: in its place and without a sync, which costs a few microseconds. So it never
/// knows more than the database, is exact for whatever is done to the files, and after a power cut is only older. Call
/// from one thread at a time.
class MarkFile {
 public:
  /// Makes the file where there is none. Throws StorageError.
  MarkFile(const std::filesystem::path& file, const std::string& store);
  ~MarkFile();
  MarkFile(const MarkFile&) = delete;
  MarkFile& operator=(const MarkFile&) = delete;

  /// Does not fail: an old mark is still true.
  void raise(std::uint64_t changes);

 private:
  std::string store_;
  int file_ = -1;
  int next_line_ = 0;
};

}  // namespace sculpt::server
