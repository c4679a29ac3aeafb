#include "server/store/sqlite/store_facts.hpp"

#include "server/store/job_store.hpp"
#include "server/store/sqlite/sqlite.hpp"

namespace sculpt::server {
namespace {

namespace fs = std::filesystem;

std::string read_text(Database& database, const char* sql) {
  Statement query(database, sql);
  return query.step() ? query.text(0) : std::string();
}

std::string quick_check(Database& database) {
  const std::string verdict = read_text(database, "PRAGMA quick_check(1)");
  return verdict == "ok" ? "" : verdict;
}

std::optional<StoreFacts> read_facts(Database& database, bool check) {
  if (read_text(database, "SELECT name FROM sqlite_schema WHERE name='meta'").empty()) return std::nullopt;
  StoreFacts facts;
  if (check) facts.damage = quick_check(database);
  facts.epoch = read_text(database, "SELECT value FROM meta WHERE name='epoch'");
  Statement changes(database, "SELECT value FROM meta WHERE name='changes'");
  if (changes.step()) facts.changes = static_cast<std::uint64_t>(changes.number(0));
  return facts;
}

}  // namespace

std::optional<StoreFacts> read_store_facts(const fs::path& file) {
  std::error_code missing;
  const std::uintmax_t size = fs::file_size(file, missing);
  if (missing || size == 0) return std::nullopt;
  Database database(file);
  // What is in the write-ahead log stays there, for whoever wants to restore the rest.
  sqlite3_db_config(database.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  try {
    return read_facts(database, size <= quick_check_bytes);
  } catch (const StorageError& error) {
    const int code = sqlite3_errcode(database.get()) & 0xff;
    if (code != SQLITE_CORRUPT && code != SQLITE_NOTADB) throw;
    return StoreFacts{{}, 0, error.what()};
  }
}

}  // namespace sculpt::server
