// The job store in SQLite: WAL, synchronous=FULL, so that a returned call survives a killed daemon and a power cut.
#include <algorithm>
#include <mutex>

#include "proto/json.hpp"
#include "server/base/job_id.hpp"
#include "server/store/job_commands.hpp"
#include "server/store/job_store.hpp"
#include "server/store/job_table.hpp"
#include "server/store/run_ending.hpp"
#include "server/store/sqlite/sqlite_rows.hpp"
#include "server/store/sqlite/sqlite_schema.hpp"
#include "server/store/sqlite/store_reader.hpp"

namespace sculpt::server {
namespace {

using enum JobState;

constexpr const char* active = "state IN ('running', 'pausing', 'cancelling')";

// The file, once what is in it is of this version.
const std::filesystem::path& up_to_date(const std::filesystem::path& file) {
  Database database(file);
  database.run("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL;");
  update_schema(database, file);
  return file;
}

class SqliteStore : public JobStore {
 public:
  SqliteStore(const std::filesystem::path& file, StoreRules rules)
      : rules_(std::move(rules)), database_(up_to_date(file)), readable_(file, Database::Use::read) {
    database_.run("PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON; PRAGMA journal_size_limit=67108864;");
    epoch_ = read_text("SELECT value FROM meta WHERE name='epoch'");
    ids_ = IdMaker(read_text("SELECT max(id) FROM (SELECT id FROM job UNION ALL SELECT id FROM removed)"));
    Statement latest(database_, "SELECT max(rank + ? * priority) FROM job");
    latest.bind(ageing()).step();
    last_rank_ms_ = latest.number(0);
    if (rules_.committed) database_.on_commit([this] { tell_changes(); });
    count_jobs();
  }

  std::string epoch() override { return epoch_; }

  Submitted submit(const NewJob& wanted) override {
    Change change(*this);
    if (const std::optional<JobRow> first = rows_.first("key=?", {wanted.key}); first && !wanted.key.empty())
      return repeat_submit(first->job, wanted);
    refuse_unserved(wanted.schedule.queue, rules_.queues);
    refuse_too_many(tally_, rules_, wanted.owner);
    const JobRow row = jobs_.insert(new_record(wanted));
    change.commit();
    return {row.job, false};
  }

  std::optional<JobRecord> claim() override {
    Change change(*this);
    if (queue_is_paused()) return std::nullopt;
    std::optional<JobRow> next =
        rows_.first(std::string("state='queued' AND queue IN (SELECT value FROM json_each(?)) AND "
                                "(start_by='' OR attempt>0 OR start_by>=?) AND (crashes=0 OR NOT EXISTS(SELECT 1 FROM "
                                "job WHERE isolated=1 AND crashes>0 AND ") +
                        active + ")) ORDER BY rank, number",
                    {queues_, jobs_.now()});
    if (!next || !has_room(next->job)) return std::nullopt;
    start_run(jobs_, rules_, *next);
    change.commit();
    return next->job;
  }

  bool finish(const std::string& id, int attempt, const Ending& ending) override {
    Change change(*this);
    std::optional<JobRow> row = owned(id, attempt);
    if (!row) return false;
    end_run(jobs_, rules_, *row, ending);
    change.commit();
    return true;
  }

  bool release(const std::string& id, int attempt) override {
    Change change(*this);
    std::optional<JobRow> row = owned(id, attempt);
    if (!row) return false;
    stop_run(jobs_, *row);
    change.commit();
    return true;
  }

  int recover() override {
    Change change(*this);
    std::vector<JobRow> left = rows_.all(std::string(active) + " ORDER BY number", {});
    for (JobRow& row : left) abandon_run(jobs_, row);
    change.commit();
    return static_cast<int>(left.size());
  }

  std::vector<std::string> wake_due() override {
    std::unique_lock lock(mutex_);
    const std::string now = jobs_.now();
    // The + keep SQLite to the index of the times: that of the states, or the table, holds the whole queue.
    std::vector<JobRow> late =
        rows_.all("start_by<>'' AND start_by<? AND attempt=0 AND +state IN ('held', 'queued') ORDER BY +number", {now});
    std::vector<JobRow> due = rows_.all(
        "state IN ('held', 'backoff') AND wake_at<=?1 AND (start_by='' OR start_by>=?1 OR attempt>0) ORDER BY number",
        {now});
    if (late.empty() && due.empty()) return {};
    Change change(*this, std::move(lock));
    std::vector<std::string> changed;
    for (JobRow& row : late) {
      expire_job(jobs_, row);
      changed.push_back(row.job.id);
    }
    for (JobRow& row : due) {
      jobs_.move(row, queued, "due");
      changed.push_back(row.job.id);
    }
    change.commit();
    return changed;
  }

  JobState cancel(const std::string& id) override {
    return change_job(id, [this](JobRow& row) { cancel_job(jobs_, row); });
  }

  JobState pause(const std::string& id) override {
    return change_job(id, [this](JobRow& row) { pause_job(jobs_, row); });
  }

  JobState resume(const std::string& id) override {
    return change_job(id, [this](JobRow& row) { resume_job(jobs_, row); });
  }

  JobState retry(const std::string& id) override {
    return change_job(id, [this](JobRow& row) { retry_job(jobs_, rules_, row); });
  }

  void set_queue_paused(bool wanted) override {
    const std::lock_guard lock(mutex_);
    Statement(database_, "INSERT INTO meta VALUES('queue_paused', ?1) ON CONFLICT(name) DO UPDATE SET value=?1")
        .bind(wanted ? "1" : "0")
        .run();
  }

  void note_damage(const std::string& id, const std::string& sentence) override {
    const std::lock_guard lock(mutex_);
    Statement update(database_,
                     "UPDATE job SET error_code=?, error_sentence=? WHERE id=? AND state IN ('succeeded', 'failed') "
                     "AND EXISTS(SELECT 1 FROM artifact WHERE artifact.job = job.number)");
    update.bind(damage_code).bind(sentence).bind(id).run();
  }

  void pin(const std::string& id, bool pinned) override {
    const std::lock_guard lock(mutex_);
    Statement update(database_, "UPDATE job SET pinned=? WHERE id=?");
    if (update.bind(pinned ? 1 : 0).bind(id).run() != 1) refuse_unknown(id);
  }

  bool remove(const std::string& id) override {
    Change change(*this);
    const std::optional<JobRow> row = jobs_.find(id);
    if (!row || !is_final(row->job.state) || row->job.pinned) return false;
    jobs_.erase(*row);
    change.commit();
    return true;
  }

  std::map<JobState, std::uint64_t> counts() override { return tally_.counts(); }
  std::uint64_t position(const JobRecord& job) override {
    return tally_.position(job.schedule.queue, job.rank, job.id);
  }
  const Histogram& commit_times() override { return database_.commit_times(); }

 protected:
  JobReader& reader() override { return reader_; }

 private:
  // What is committed is so, even if the database cannot be asked any more.
  void tell_changes() try { rules_.committed(rows_.changes()); } catch (const StorageError&) {
  }

  /// One change of the store: its lock, and a transaction that is undone unless committed. What moved is counted when
  /// it is committed.
  class Change {
   public:
    explicit Change(SqliteStore& store) : Change(store, std::unique_lock(store.mutex_)) {}
    Change(SqliteStore& store, std::unique_lock<std::mutex> lock)
        : store_(store), lock_(std::move(lock)), transaction_(store.database_) {
      store.jobs_.take_moves();
    }
    void commit() {
      transaction_.commit();
      store_.tally_.apply(store_.jobs_.take_moves());
    }

   private:
    SqliteStore& store_;
    std::unique_lock<std::mutex> lock_;
    Transaction transaction_;
  };

  std::int64_t ageing() const { return static_cast<std::int64_t>(rules_.ageing_ms); }

  std::string read_text(const char* sql) {
    Statement query(database_, sql);
    return query.step() ? query.text(0) : std::string();
  }

  bool queue_is_paused() { return read_text("SELECT value FROM meta WHERE name='queue_paused'") == "1"; }

  // The rank counts from a time that never goes back, so that a clock that was set back lets no new job overtake.
  JobRecord new_record(const NewJob& wanted) {
    const std::uint64_t now_ms = jobs_.now_ms();
    last_rank_ms_ = std::max(last_rank_ms_, static_cast<std::int64_t>(now_ms));
    return make_job(wanted, ids_.next(now_ms), now_ms, last_rank_ms_, rules_);
  }

  // A row in a state that nobody knows is not counted.
  void count_jobs() {
    Statement query(database_, "SELECT rank, id, owner, queue, state FROM job");
    while (query.step())
      tally_.apply(
          {{query.number(0), query.text(1), query.text(2), query.text(3), std::nullopt, find_state(query.text(4))}});
  }

  bool has_room(const JobRecord& job) {
    Statement query(database_, std::string("SELECT count(*), coalesce(sum(memory_bytes), 0) FROM job WHERE ") + active);
    query.step();
    const auto taken = static_cast<std::uint64_t>(query.number(1));
    return query.number(0) == 0 || rules_.memory_bytes == 0 || taken + job.memory_bytes <= rules_.memory_bytes;
  }

  std::optional<JobRow> owned(const std::string& id, int attempt) {
    std::optional<JobRow> row = jobs_.find(id);
    return row && row->job.attempt == attempt && is_active(row->job.state) ? row : std::nullopt;
  }

  template <typename Act>
  JobState change_job(const std::string& id, Act act) {
    Change change(*this);
    std::optional<JobRow> row = jobs_.find(id);
    if (!row) refuse_unknown(id);
    act(*row);
    change.commit();
    return row->job.state;
  }

  std::mutex mutex_;  // of what changes; the reader and the tally have their own
  StoreRules rules_;
  std::string queues_ = proto::write_json(rules_.queues);
  Database database_;
  SqliteRows rows_{database_};
  JobTable jobs_{rows_, rules_.now_ms ? rules_.now_ms : unix_ms};
  Database readable_;  // closed before the one that writes, which tidies up
  StoreReader reader_{readable_};
  JobTally tally_;
  std::string epoch_;
  IdMaker ids_;
  std::int64_t last_rank_ms_ = 0;
};

}  // namespace

std::unique_ptr<JobStore> open_sqlite_store(const std::filesystem::path& file, StoreRules rules) {
  return std::make_unique<SqliteStore>(file, std::move(rules));
}

}  // namespace sculpt::server
