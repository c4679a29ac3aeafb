#include "server/store/sqlite/sqlite.hpp"

#include "server/base/crash_point.hpp"
#include "server/files/durable.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {
namespace {

constexpr int busy_timeout_ms = 5000;

[[noreturn]] void fail(sqlite3* handle, const char* doing) {
  const int error = sqlite3_extended_errcode(handle);
  if (error == SQLITE_IOERR_FSYNC || error == SQLITE_IOERR_DIR_FSYNC) end_after_failed_sync("the database");
  const std::string sentence = std::string("the database failed to ") + doing + ": " + sqlite3_errmsg(handle);
  if (error == SQLITE_FULL) throw StorageFull(sentence + ": make space, then try again");
  throw StorageError(sentence);
}

sqlite3* open(const std::filesystem::path& file, Database::Use use) {
  sqlite3* handle = nullptr;
  const int flags = use == Database::Use::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  if (sqlite3_open_v2(file.c_str(), &handle, flags | SQLITE_OPEN_NOMUTEX, nullptr) != SQLITE_OK) {
    const std::string why = handle != nullptr ? sqlite3_errmsg(handle) : "out of memory";
    sqlite3_close(handle);
    throw StorageError("cannot open the database '" + file.string() + "': " + why);
  }
  return handle;
}

}  // namespace

Database::Database(const std::filesystem::path& file, Use use) : handle_(open(file, use), sqlite3_close) {
  sqlite3_extended_result_codes(get(), 1);
  sqlite3_busy_timeout(get(), busy_timeout_ms);
}

void Database::run(const char* sql) {
  if (sqlite3_exec(get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail(get(), "run a statement");
}

IdleStatement& Database::idle(std::string_view sql) {
  const auto found = idle_.find(sql);
  return found != idle_.end() ? found->second : idle_.try_emplace(std::string(sql)).first->second;
}

Statement::Statement(Database& database, std::string_view sql)
    : database_(&database), handle_(nullptr, EndUse{&database.idle(sql)}) {
  sqlite3_stmt* handle = handle_.get_deleter().place->release();
  if (handle == nullptr && sqlite3_prepare_v3(database.get(), sql.data(), static_cast<int>(sql.size()),
                                              SQLITE_PREPARE_PERSISTENT, &handle, nullptr) != SQLITE_OK) {
    fail(database.get(), "prepare a statement");
  }
  handle_.reset(handle);
}

Statement& Statement::bind(std::string_view text) {
  if (sqlite3_bind_text64(handle_.get(), ++bound_, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8) !=
      SQLITE_OK) {
    fail(database_->get(), "bind a text");
  }
  return *this;
}

Statement& Statement::bind(std::int64_t number) {
  if (sqlite3_bind_int64(handle_.get(), ++bound_, number) != SQLITE_OK) fail(database_->get(), "bind a number");
  return *this;
}

Statement& Statement::bind_null() {
  if (sqlite3_bind_null(handle_.get(), ++bound_) != SQLITE_OK) fail(database_->get(), "bind a null");
  return *this;
}

bool Statement::step() {
  const int result = sqlite3_step(handle_.get());
  if (result != SQLITE_ROW && result != SQLITE_DONE) fail(database_->get(), "read or write");
  return result == SQLITE_ROW;
}

int Statement::run() {
  step();
  return database_->changes();
}

std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  return text == nullptr ? std::string()
                         : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column)));
}

Transaction::Transaction(Database& database) : database_(&database) {
  database.run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (open_) sqlite3_exec(database_->get(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  crash_point(CrashPoint::before_commit);
  const auto begun = std::chrono::steady_clock::now();
  database_->run("COMMIT");
  open_ = false;
  database_->commit_times().add(std::chrono::steady_clock::now() - begun);
  crash_point(CrashPoint::after_commit);
  database_->committed();
}

}  // namespace sculpt::server
