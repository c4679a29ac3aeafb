#include "server/fleet/fleet_queue.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "server/fleet/fleet_schema.hpp"
#include "server/store/run_ending.hpp"

namespace sculpt::server {
namespace {

using enum JobState;

// Whether a daemon may claim at all.
constexpr const char* permission =
    "SELECT (SELECT value FROM sculptd.meta WHERE name='queue_paused') = '1', "
    "(SELECT value FROM sculptd.meta WHERE name='schema')::bigint";
// The first value, or the database's time, as the store writes times.
const std::string now_text = "coalesce($1, to_char(now() AT TIME ZONE 'UTC', 'YYYY-MM-DD\"T\"HH24:MI:SS.MS\"Z\"'))";
// None overtakes one that waits for room here, unless there is never room for it here, but in a daemon that was heard
// of lately. The row is found and locked by one plain statement, at the head of one index: below another one, or for
// several queues at once, more rows may be locked than are wanted.
const std::string next_in_queue =
    "WHERE queue=$5 AND state='queued' AND (start_by='' OR attempt>0 OR start_by >= " + now_text +
    ") AND (crashes=0 OR NOT $2) AND rank >= $4 AND ($3::bigint=0 OR memory_bytes<=$3 OR NOT EXISTS(SELECT 1 FROM "
    "sculptd.daemon WHERE seen > now() - interval '1 minute' AND daemon.queues ? job.queue AND (daemon.memory_bytes=0 "
    "OR daemon.memory_bytes>=job.memory_bytes))) ORDER BY rank, number LIMIT 1 FOR UPDATE SKIP LOCKED";
const std::string anything_due =
    "SELECT EXISTS(SELECT 1 FROM sculptd.job WHERE start_by<>'' AND start_by<" + now_text +
    " AND attempt=0 AND state IN ('held', 'queued')) OR EXISTS(SELECT 1 FROM sculptd.job WHERE state IN ('held', "
    "'backoff') AND wake_at<=" +
    now_text +
    ") OR EXISTS(SELECT 1 FROM sculptd.job JOIN sculptd.lease ON lease.job = job.number WHERE id = ANY($2::text[]) AND "
    "until < now())";

// Of what is due, so many in one transaction: the rest a moment later. Others wait for it, and it has its time too.
constexpr const char* at_once = " ORDER BY number LIMIT 500 ";

constexpr const char* late = "WHERE start_by<>'' AND start_by<$1 AND attempt=0 AND state IN ('held', 'queued')";
constexpr const char* due =
    "WHERE state IN ('held', 'backoff') AND wake_at<=$1 AND (start_by='' OR start_by>=$1 OR attempt>0)";
constexpr const char* unheld =
    "JOIN sculptd.lease ON lease.job = job.number WHERE id = ANY($1::text[]) AND until < now()";

// A test's clock, or none.
SqlValue time_of(const StoreRules& rules) {
  return rules.now_ms ? sql_value(utc_text(rules.now_ms())) : std::nullopt;
}

bool knows_schema(std::int64_t version, std::atomic<std::int64_t>& newer) {
  if (version <= fleet_schema_version) return true;
  if (newer.exchange(version) != version) spdlog::error("{}", schema_too_new(version));
  return false;
}

}  // namespace

std::string schema_too_new(std::int64_t version) {
  if (version <= fleet_schema_version) return {};
  return "the tables of the database were brought to version " + std::to_string(version) +
         " by a newer sculptd, and this one knows version " + std::to_string(fleet_schema_version) +
         ": it takes no jobs any more, update it";
}

std::optional<JobRow> next_job(FleetChange& change, const Claimant& claimant, const StoreRules& rules,
                               std::atomic<std::int64_t>& newer_schema) {
  std::vector<Question> questions{{permission}};
  for (const std::string& queue : rules.queues)
    questions.push_back(FleetRows::selection(
        next_in_queue,
        {time_of(rules), sql_flag(claimant.at_work.suspect), sql_value(static_cast<std::int64_t>(rules.memory_bytes)),
         sql_value(claimant.tally.first_rank(queue).value_or(INT64_MIN)), sql_value(queue)}));
  const std::vector<Answered> answers = change.transaction.ask_all(questions);
  if (answers[0].flag(0, 0) || !knows_schema(answers[0].number(0, 1), newer_schema)) return std::nullopt;
  std::vector<JobRow> next;
  for (auto answer = answers.begin() + 1; answer != answers.end(); ++answer)
    std::ranges::move(FleetRows::rows_of(*answer), std::back_inserter(next));
  if (next.empty()) return std::nullopt;
  std::ranges::sort(next, {}, [](const JobRow& row) { return std::pair(row.job.rank, row.number); });
  const std::uint64_t room = rules.memory_bytes;
  const std::uint64_t needed = claimant.at_work.memory_bytes + next.front().job.memory_bytes;
  if (claimant.at_work.jobs > 0 && room != 0 && needed > room) return std::nullopt;
  return std::move(next.front());
}

bool is_anything_due(Postgres& database, const StoreRules& rules, const SqlValue& at_work) {
  return database.ask_again({{anything_due, {time_of(rules), at_work}}}).front().flag(0, 0);
}

std::vector<std::string> change_due(FleetChange& change, const SqlValue& at_work) {
  const SqlValue now = sql_value(change.jobs.now());
  std::vector<std::string> changed;
  const auto each = [&](const std::string& which, const std::vector<SqlValue>& values, const auto& act) {
    for (JobRow& row : change.rows.select(which, values)) {
      act(row);
      changed.push_back(row.job.id);
    }
  };
  const std::string locked = std::string(at_once) + "FOR UPDATE OF job SKIP LOCKED";
  each(late + locked, {now}, [&](JobRow& row) { expire_job(change.jobs, row); });
  each(due + locked, {now}, [&](JobRow& row) { change.jobs.move(row, queued, "due"); });
  // The lease is locked and looked at again: its daemon may be renewing it.
  each(std::string(unheld) + at_once + "FOR UPDATE OF job, lease SKIP LOCKED", {at_work}, [&](JobRow& row) {
    spdlog::warn("job={} attempt={} its daemon was silent for longer than its lease: others may go on with it",
                 row.job.id, row.job.attempt);
    abandon_run(change.jobs, row);
  });
  return changed;
}

}  // namespace sculpt::server
