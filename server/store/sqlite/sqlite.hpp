// The few SQLite calls that the store needs, as objects that clean up after themselves and throw StorageError.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "server/base/histogram.hpp"

namespace sculpt::server {

struct FinalizeStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
/// One that waits for its next use, or none.
using IdleStatement = std::unique_ptr<sqlite3_stmt, FinalizeStatement>;

/// One connection. Not shared between threads without a lock. It outlives its statements and is not moved while there
/// are any.
class Database {
 public:
  enum class Use { write, read };

  /// For writing the file is made where there is none.
  explicit Database(const std::filesystem::path& file, Use use = Use::write);
  void run(const char* sql);
  sqlite3* get() const { return handle_.get(); }
  /// Of the transactions that were committed.
  Histogram& commit_times() { return commit_times_; }
  /// Called after each transaction that was committed, on its thread.
  void on_commit(std::function<void()> told) { on_commit_ = std::move(told); }
  void committed() const {
    if (on_commit_) on_commit_();
  }
  int changes() const { return sqlite3_changes(handle_.get()); }
  /// Where the statement of this text waits between its uses: to prepare it takes longer than to run it. The address
  /// stays. Texts are few: values are bound, not written into them.
  IdleStatement& idle(std::string_view sql);

 private:
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> handle_;
  std::map<std::string, IdleStatement, std::less<>> idle_;
  Histogram commit_times_;
  std::function<void()> on_commit_;
};

/// Makes a statement that was used idle again.
struct EndUse {
  IdleStatement* place;
  void operator()(sqlite3_stmt* statement) const {
    sqlite3_reset(statement);
    sqlite3_clear_bindings(statement);
    place->reset(statement);
  }
};

/// A prepared statement; parameters are bound from 1 in the order of the calls.
class Statement {
 public:
  Statement(Database& database, std::string_view sql);
  Statement& bind(std::string_view text);
  Statement& bind(std::int64_t number);
  Statement& bind_null();
  /// True while there is a row.
  bool step();
  /// For statements without rows: how many rows they changed.
  int run();
  std::string text(int column) const;
  std::int64_t number(int column) const { return sqlite3_column_int64(handle_.get(), column); }
  bool flag(int column) const { return number(column) != 0; }

 private:
  Database* database_;
  std::unique_ptr<sqlite3_stmt, EndUse> handle_;
  int bound_ = 0;
};

/// BEGIN IMMEDIATE, so that a busy database is waited for; rolled back unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database* database_;
  bool open_ = true;
};

}  // namespace sculpt::server
