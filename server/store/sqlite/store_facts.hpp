// What a database says about itself, without changing it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace sculpt::server {

struct StoreFacts {
  std::string epoch;
  std::uint64_t changes = 0;  ///< see SqliteRows::changes; 0 of one that was made before they were counted
  std::string damage;         ///< what SQLite's quick_check finds first; empty: nothing, or not looked for
};

/// Nothing for a file that is missing, empty, or has no tables. A database over this size is not checked.
inline constexpr std::uintmax_t quick_check_bytes = 256 << 20;
/// Throws StorageError (no rights, or the disk fails).
std::optional<StoreFacts> read_store_facts(const std::filesystem::path& database);

}  // namespace sculpt::server
