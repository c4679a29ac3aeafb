#include "server/fleet/postgres_change.hpp"

#include <utility>

#include "server/base/crash_point.hpp"
#include "server/fleet/fleet_schema.hpp"

namespace sculpt::server {
namespace {

const Question lock_question{"SELECT pg_advisory_xact_lock($1)", {sql_value(FleetLock::events)}};
const Question time_question{"SELECT floor(extract(epoch FROM now()) * 1000)::bigint"};

}  // namespace

PostgresChange::~PostgresChange() {
  if (!open_ || !database_.connected() || database_.generation() != generation_) return;
  try {
    database_.ask({"ROLLBACK"});
  } catch (const StorageError&) {
    database_.drop();  // the database undoes what a connection leaves
  }
}

std::vector<Answered> PostgresChange::begin_with(std::vector<Question> first) {
  first.insert(first.begin(), {{"BEGIN"}, time_question});
  try {
    std::vector<Answered> answers = database_.ask_again(first);
    open_ = true;
    generation_ = database_.generation();
    now_ms_ = static_cast<std::uint64_t>(answers[1].number(0, 0));
    return answers;
  } catch (const StorageError&) {
    database_.drop();  // it may have begun
    throw;
  }
}

void PostgresChange::begin() {
  if (!open_) begin_with({});
}

// What is asked over another connection would be no part of the transaction.
void PostgresChange::expect_connection() const {
  if (database_.connected() && database_.generation() == generation_) return;
  throw DatabaseUnavailable(
      "the connection to the database broke in the middle of a change, which is undone: try again");
}

std::vector<Answered> PostgresChange::ask_all(const std::vector<Question>& questions) {
  if (open_) {
    expect_connection();
    return database_.ask_all(questions);
  }
  std::vector<Answered> answers = begin_with(questions);
  answers.erase(answers.begin(), answers.begin() + 2);
  return answers;
}

std::uint64_t PostgresChange::now_ms() {
  begin();
  return now_ms_;
}

std::vector<Answered> PostgresChange::lock_events(std::vector<Question> questions) {
  questions.insert(questions.begin(), lock_question);
  std::vector<Answered> answers = ask_all(questions);
  locked_ = true;
  answers.erase(answers.begin());
  return answers;
}

void PostgresChange::lock_events_later() {
  if (!locked_ && !std::exchange(locks_later_, true)) later_.push_back(lock_question);
}

std::vector<Answered> PostgresChange::commit(Histogram& times, const std::vector<Question>& after) {
  begin();
  expect_connection();
  crash_point(CrashPoint::before_commit);
  const auto begun = std::chrono::steady_clock::now();
  const auto done = static_cast<std::ptrdiff_t>(later_.size());
  later_.push_back({"COMMIT"});
  later_.insert(later_.end(), after.begin(), after.end());
  std::vector<Answered> answers;
  try {
    answers = database_.ask_all(later_);
  } catch (const DatabaseUnavailable& error) {
    open_ = false;
    database_.drop();
    throw CommitUnknown(error.what());
  }
  open_ = false;
  times.add(std::chrono::steady_clock::now() - begun);
  crash_point(CrashPoint::after_commit);
  answers.erase(answers.begin() + done);
  return answers;
}

}  // namespace sculpt::server
