// A transaction in PostgreSQL in few trips: it begins with its first question, and what needs no answer goes with the
// commit.
#pragma once

#include <functional>
#include <vector>

#include "server/base/histogram.hpp"
#include "server/base/storage_error.hpp"
#include "server/fleet/postgres.hpp"

namespace sculpt::server {

/// The connection broke while a transaction was being committed: it is, or it is not.
class CommitUnknown : public DatabaseUnavailable {
 public:
  using DatabaseUnavailable::DatabaseUnavailable;
};

/// Undone unless committed. Belongs to the thread that has the connection.
class PostgresChange {
 public:
  explicit PostgresChange(Postgres& database) : database_(database) {}
  ~PostgresChange();
  PostgresChange(const PostgresChange&) = delete;
  PostgresChange& operator=(const PostgresChange&) = delete;

  Answered ask(const Question& question) { return ask_all({question}).front(); }
  /// In one trip.
  std::vector<Answered> ask_all(const std::vector<Question>& questions);
  /// Asked with the commit, in the order of the calls.
  void later(Question question) { later_.push_back(std::move(question)); }
  /// Before the next event's number is taken and until the end: nobody else has one meanwhile.
  void lock_events_later();
  /// At once, and behind it in the same trip these questions, which see all that others have committed.
  std::vector<Answered> lock_events(std::vector<Question> questions);
  /// Gives the answers to what was asked later, in order, then those to `after`, which is asked behind the commit in
  /// the same trip. Throws CommitUnknown too. The time is counted in `times`.
  std::vector<Answered> commit(Histogram& times, const std::vector<Question>& after = {});
  /// The database's wall time when this began.
  std::uint64_t now_ms();

 private:
  void begin();
  std::vector<Answered> begin_with(std::vector<Question> first);
  void expect_connection() const;

  Postgres& database_;
  std::vector<Question> later_;
  std::uint64_t now_ms_ = 0, generation_ = 0;
  bool open_ = false, locks_later_ = false, locked_ = false;
};

}  // namespace sculpt::server
