// The few libpq calls that the store of a fleet needs: a connection that is made anew when it broke, questions with a
// limit to their time, several of them in one trip. Throws StorageError; DatabaseUnavailable where a later try may
// help.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

struct pg_conn;
struct pg_result;

namespace sculpt::server {

/// Where the database is. The address may be anything that libpq takes; the password may stand in a file of its own.
struct PostgresSource {
  std::string url;                      ///< "postgresql://USER@HOST/DATABASE?sslmode=verify-full"
  std::filesystem::path password_file;  ///< read at each connect; empty: none
  /// Shared by the connections that are made with copies of this: when (of the steady clock) the youngest was made that
  /// answers where an older one had gone silent. What is older than that is not trusted any more: a connection that is
  /// half gone gives no error.
  std::shared_ptr<std::atomic<std::int64_t>> renewed = std::make_shared<std::atomic<std::int64_t>>(INT64_MIN);
};

/// A value of a statement; nothing: null.
using SqlValue = std::optional<std::string>;
SqlValue sql_value(std::int64_t number);
/// As PostgreSQL takes it: without bytes that are no UTF-8, and without NUL.
SqlValue sql_value(const std::string& text);
SqlValue sql_flag(bool flag);

struct Question {
  std::string sql;  ///< one statement, with $1, $2, ... for the values
  std::vector<SqlValue> values = {};
  std::optional<std::string> bytes = {};  ///< one more value, behind the others: a bytea, as it is
  bool raw = false;                       ///< the answer is of bytea, as it is: Answered::text
};

class Answered {
 public:
  explicit Answered(pg_result* result);
  int rows() const;
  std::string text(int row, int column) const;
  std::int64_t number(int row, int column) const;
  bool flag(int row, int column) const;
  /// It answers a statement that begins with this word.
  bool is(std::string_view command) const;
  /// For statements without rows: how many they changed.
  std::int64_t changed() const;

 private:
  std::shared_ptr<pg_result> result_;
};

/// Not shared between threads without a lock. Connects at the first question; a broken connection is made anew at the
/// next, but not more often than twice a second.
class Postgres {
 public:
  /// A question that takes longer than `patience` breaks the connection.
  Postgres(PostgresSource source, std::chrono::milliseconds patience);
  ~Postgres();
  Postgres(const Postgres&) = delete;
  Postgres& operator=(const Postgres&) = delete;

  Answered ask(const Question& question);
  /// All in one trip, in order. None behind one that fails is done.
  std::vector<Answered> ask_all(const std::vector<Question>& questions);
  /// The same, and once more where it turns out that the connection of the last question is gone, or half gone: for
  /// what may be done twice.
  std::vector<Answered> ask_again(const std::vector<Question>& questions);
  /// Several statements, with a semicolon each, as one transaction.
  void run(const std::string& statements);
  /// Waits for a NOTIFY on a channel that this connection listens to. False: none came.
  bool await_notice(std::chrono::milliseconds patience);
  /// Ends the connection; the next question makes another.
  void drop();
  bool connected() const { return connection_ != nullptr; }
  /// Rises with each connection that was made: what belonged to one before is gone.
  std::uint64_t generation() const { return generation_; }

 private:
  using Clock = std::chrono::steady_clock;

  void connect();
  bool is_distrusted() const;
  void prepare(const std::string& sql);
  void send(const Question& question);
  void leave_pipeline(Clock::time_point end);
  Answered next_result(Clock::time_point end);
  void await_result(Clock::time_point end);
  [[noreturn]] void fail(const pg_result* result);
  [[noreturn]] void lose(const std::string& why);

  PostgresSource source_;
  std::chrono::milliseconds patience_;
  pg_conn* connection_ = nullptr;
  std::uint64_t generation_ = 0;
  std::int64_t made_ = 0;     // the connection, by the steady clock
  bool went_silent_ = false;  // the one before
  std::set<std::string> prepared_;
  Clock::time_point next_try_{};
  std::string last_fault_;
};

}  // namespace sculpt::server
