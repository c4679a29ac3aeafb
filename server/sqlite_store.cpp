// The job store in SQLite: WAL, synchronous=FULL, so that a returned call survives a killed daemon and a power cut.
#include <algorithm>
#include <mutex>

#include "proto/error_codes.hpp"
#include "server/job_id.hpp"
#include "server/job_store.hpp"
#include "server/job_table.hpp"
#include "server/sqlite_schema.hpp"

namespace sculpt {
namespace {

using enum JobState;

constexpr const char* damage_code = "artifact_damaged";
constexpr const char* active = "state IN ('running', 'pausing', 'cancelling')";

[[noreturn]] void refuse(const JobRecord& job, const std::string& what) {
  throw ProtocolError("wrong_state", "job " + job.id + " is " + name(job.state) + " and cannot be " + what);
}

[[noreturn]] void refuse_unknown(const std::string& id) {
  throw ProtocolError("not_found", "there is no job '" + id + "'", "/params/job");
}

class SqliteStore : public JobStore {
 public:
  SqliteStore(const std::filesystem::path& file, StoreRules rules)
      : rules_(std::move(rules)), database_(file), jobs_(database_, rules_) {
    database_.run("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON;");
    database_.run("PRAGMA journal_size_limit=67108864;");
    update_schema(database_, file);
    epoch_ = read_text("SELECT value FROM meta WHERE name='epoch'");
    ids_ = IdMaker(read_text("SELECT max(id) FROM (SELECT id FROM job UNION ALL SELECT id FROM removed)"));
    Statement latest(database_, "SELECT max(rank + ? * priority) FROM job");
    latest.bind(ageing()).step();
    last_rank_ms_ = latest.number(0);
    if (rules_.committed) database_.on_commit([this] { tell_changes(); });
  }

  std::string epoch() override { return epoch_; }

  Submitted submit(const NewJob& wanted) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    if (const std::optional<JobRow> first = jobs_.find_key(wanted.key); first && !wanted.key.empty()) {
      if (first->job.spec != wanted.spec) {
        throw ProtocolError("key_conflict",
                            "the key '" + wanted.key + "' belongs to job " + first->job.id +
                                ", which has another spec: use a new key for a new job",
                            "/params/key");
      }
      return {first->job, true};
    }
    refuse_too_many(wanted.owner);
    const JobRow row = jobs_.insert(new_record(wanted));
    transaction.commit();
    return {row.job, false};
  }

  std::optional<JobRecord> claim() override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    if (queue_is_paused()) return std::nullopt;
    std::optional<JobRow> next =
        jobs_.first(std::string("state='queued' AND (start_by='' OR attempt>0 OR start_by>=?) AND "
                                "(crashes=0 OR NOT EXISTS(SELECT 1 FROM job WHERE isolated=1 AND crashes>0 AND ") +
                        active + ")) ORDER BY rank, number",
                    {jobs_.now()});
    if (!next || !has_room(next->job)) return std::nullopt;
    JobRecord& job = next->job;
    job.isolated = rules_.isolate || job.crashes > 0;
    if (!job.isolated) ++job.crashes;  // taken back when the run ends while the daemon lives
    job.error_code.clear();
    job.error_sentence.clear();
    jobs_.move(*next, running, "claimed");
    transaction.commit();
    return job;
  }

  bool finish(const std::string& id, int attempt, const Ending& ending) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    std::optional<JobRow> row = owned(id, attempt);
    if (!row) return false;
    acquit(row->job);
    if (row->job.state == cancelling) {
      jobs_.move(*row, cancelled, "finished");
    } else {
      end(*row, ending);
    }
    transaction.commit();
    return true;
  }

  bool release(const std::string& id, int attempt) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    std::optional<JobRow> row = owned(id, attempt);
    if (!row) return false;
    acquit(row->job);
    let_go(*row);
    transaction.commit();
    return true;
  }

  int recover() override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    std::vector<JobRow> left = jobs_.all(std::string(active) + " ORDER BY number", {});
    for (JobRow& row : left) let_go(row);
    transaction.commit();
    return static_cast<int>(left.size());
  }

  std::vector<std::string> wake_due() override {
    const std::lock_guard lock(mutex_);
    const std::string now = jobs_.now();
    std::vector<JobRow> late =
        jobs_.all("start_by<>'' AND start_by<? AND attempt=0 AND state IN ('held', 'queued') ORDER BY number", {now});
    std::vector<JobRow> due = jobs_.all(
        "state IN ('held', 'backoff') AND wake_at<=?1 AND (start_by='' OR start_by>=?1 OR attempt>0) ORDER BY number",
        {now});
    if (late.empty() && due.empty()) return {};
    Transaction transaction(database_);
    std::vector<std::string> changed;
    for (JobRow& row : late) {
      row.job.error_code = "expired";
      row.job.error_sentence =
          "it could not start by " + row.job.schedule.start_by + ": submit it again with more time";
      jobs_.move(row, expired, "start_by_passed");
      changed.push_back(row.job.id);
    }
    for (JobRow& row : due) {
      jobs_.move(row, queued, "due");
      changed.push_back(row.job.id);
    }
    transaction.commit();
    return changed;
  }

  JobState cancel(const std::string& id) override {
    return change(id, [this](JobRow& row) {
      const JobState state = row.job.state;
      if (state == cancelled || state == cancelling) return;
      if (is_final(state)) refuse(row.job, "cancelled any more");
      jobs_.move(row, is_active(state) ? cancelling : cancelled, "cancel_requested");
    });
  }

  JobState pause(const std::string& id) override {
    return change(id, [this](JobRow& row) {
      const JobState state = row.job.state;
      if (state == paused || state == pausing) return;
      if (is_final(state) || state == cancelling) refuse(row.job, "paused");
      jobs_.move(row, state == running ? pausing : paused, "pause_requested");
    });
  }

  JobState resume(const std::string& id) override {
    return change(id, [this](JobRow& row) {
      JobRecord& job = row.job;
      if (is_final(job.state) || job.state == cancelling) refuse(job, "resumed");
      if (job.state == pausing) refuse(job, "resumed before it is paused: try again in a moment");
      if (job.state != paused) return;
      const bool early = job.schedule.not_before > jobs_.now();
      if (early) job.wake_at = job.schedule.not_before;
      jobs_.move(row, early ? held : queued, "resumed");
    });
  }

  JobState retry(const std::string& id) override {
    return change(id, [this](JobRow& row) {
      JobRecord& job = row.job;
      const bool damaged = job.error_code == damage_code;
      if (job.state != quarantined && !damaged)
        refuse(job, "retried: only quarantined jobs are, and those with a damaged artifact");
      job.crashes = damaged ? 0 : std::max(1, rules_.max_crashes - 1);
      Statement(database_, "DELETE FROM artifact WHERE job=?").bind(row.number).run();
      job.failures = 0;
      job.error_code.clear();
      job.error_sentence.clear();
      jobs_.move(row, queued, "retried");
    });
  }

  void set_queue_paused(bool wanted) override {
    const std::lock_guard lock(mutex_);
    Statement(database_, "INSERT INTO meta VALUES('queue_paused', ?1) ON CONFLICT(name) DO UPDATE SET value=?1")
        .bind(wanted ? "1" : "0")
        .run();
  }

  bool queue_paused() override {
    const std::lock_guard lock(mutex_);
    return queue_is_paused();
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
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    const std::optional<JobRow> row = jobs_.find(id);
    if (!row || !is_final(row->job.state) || row->job.pinned) return false;
    for (const char* sql :
         {"DELETE FROM event WHERE job=?", "DELETE FROM artifact WHERE job=?", "DELETE FROM job WHERE number=?"}) {
      Statement(database_, sql).bind(row->number).run();
    }
    Statement(database_, "INSERT INTO removed VALUES(?)").bind(id).run();
    jobs_.count_change();
    transaction.commit();
    return true;
  }

  bool was_removed(const std::string& id) override {
    const std::lock_guard lock(mutex_);
    Statement query(database_, "SELECT 1 FROM removed WHERE id=?");
    return query.bind(id).step();
  }

  std::optional<JobRecord> find(const std::string& id) override {
    const std::lock_guard lock(mutex_);
    const std::optional<JobRow> row = jobs_.find(id);
    return row ? std::optional(row->job) : std::nullopt;
  }

  std::optional<JobRecord> find_key(const std::string& key) override {
    const std::lock_guard lock(mutex_);
    const std::optional<JobRow> row = jobs_.find_key(key);
    return row ? std::optional(row->job) : std::nullopt;
  }

  std::vector<JobRecord> list(const std::string& after, int limit) override {
    const std::lock_guard lock(mutex_);
    std::vector<JobRecord> listed;
    for (JobRow& row : jobs_.all("id>? ORDER BY id LIMIT " + std::to_string(limit), {after}))
      listed.push_back(std::move(row.job));
    return listed;
  }

  std::map<JobState, std::uint64_t> counts() override {
    const std::lock_guard lock(mutex_);
    std::map<JobState, std::uint64_t> counts;
    for (const JobState state : job_states) {
      Statement query(database_, "SELECT count(*) FROM job WHERE state=?");
      query.bind(name(state)).step();
      counts[state] = static_cast<std::uint64_t>(query.number(0));
    }
    return counts;
  }

  std::uint64_t queue_age_s() override {
    const std::lock_guard lock(mutex_);
    Statement query(database_, "SELECT max(0, unixepoch() - unixepoch(min(submitted_at))) FROM job WHERE state=?");
    query.bind(name(JobState::queued)).step();
    return static_cast<std::uint64_t>(query.number(0));
  }

  const Histogram& commit_times() override { return database_.commit_times(); }

  std::uint64_t position(const JobRecord& job) override {
    const std::lock_guard lock(mutex_);
    Statement query(database_,
                    "SELECT count(*) FROM job WHERE state='queued' AND (rank < ?1 OR (rank = ?1 AND id < ?2))");
    query.bind(job.rank).bind(job.id).step();
    return static_cast<std::uint64_t>(query.number(0));
  }

  std::vector<StateEvent> events(const std::string& id, std::uint64_t after, int limit) override {
    const std::lock_guard lock(mutex_);
    Statement query(database_,
                    "SELECT seq, time, data, event.state FROM event JOIN job ON event.job = job.number "
                    "WHERE job.id=? AND seq>? ORDER BY seq LIMIT ?");
    query.bind(id).bind(static_cast<std::int64_t>(std::min<std::uint64_t>(after, INT64_MAX))).bind(limit);
    std::vector<StateEvent> events;
    while (query.step()) {
      const auto seq = static_cast<std::uint64_t>(query.number(0));
      events.push_back({seq, query.text(1), query.text(2), find_state(query.text(3)).value_or(failed)});
    }
    return events;
  }

  std::uint64_t last_event(const std::string& id) override {
    const std::lock_guard lock(mutex_);
    Statement query(database_, "SELECT max(seq) FROM event JOIN job ON event.job = job.number WHERE job.id=?");
    query.bind(id).step();
    return static_cast<std::uint64_t>(query.number(0));
  }

  std::vector<StoredArtifact> artifacts(const std::string& id) override {
    const std::lock_guard lock(mutex_);
    Statement query(database_,
                    "SELECT artifact, format, size, sha256 FROM artifact JOIN job ON artifact.job = job.number "
                    "WHERE job.id=? ORDER BY place");
    query.bind(id);
    std::vector<StoredArtifact> artifacts;
    while (query.step()) {
      artifacts.push_back({query.text(0), query.text(1), static_cast<std::uint64_t>(query.number(2)), query.text(3)});
    }
    return artifacts;
  }

 private:
  // What is committed is so, even if the database cannot be asked any more.
  void tell_changes() try { rules_.committed(jobs_.changes()); } catch (const StorageError&) {
  }

  std::int64_t ageing() const { return static_cast<std::int64_t>(rules_.ageing_ms); }

  std::string read_text(const char* sql) {
    Statement query(database_, sql);
    return query.step() ? query.text(0) : std::string();
  }

  bool queue_is_paused() { return read_text("SELECT value FROM meta WHERE name='queue_paused'") == "1"; }

  // The rank counts from a time that never goes back, so that a clock that was set back lets no new job overtake.
  JobRecord new_record(const NewJob& wanted) {
    const std::uint64_t now_ms = rules_.now_ms();
    last_rank_ms_ = std::max(last_rank_ms_, static_cast<std::int64_t>(now_ms));
    JobRecord job;
    job.id = ids_.next(now_ms);
    job.key = wanted.key;
    job.owner = wanted.owner;
    job.schedule = wanted.schedule;
    job.spec = wanted.spec;
    job.cell_bundle = wanted.cell_bundle;
    job.memory_bytes = wanted.memory_bytes;
    job.rank = last_rank_ms_ - ageing() * wanted.schedule.priority;
    job.submitted_at = utc_text(now_ms);
    if (wanted.schedule.not_before > job.submitted_at) {
      job.state = held;
      job.wake_at = wanted.schedule.not_before;
    }
    return job;
  }

  void refuse_too_many(const std::string& owner) {
    if (count_open({}) >= rules_.max_jobs) {
      throw ProtocolError("queue_full",
                          "the server has " + std::to_string(rules_.max_jobs) +
                              " jobs that have not ended, as many as it may: try again when some have, or "
                              "raise max_jobs");
    }
    if (!owner.empty() && count_open(owner) >= rules_.max_jobs_per_owner) {
      throw ProtocolError("quota", "'" + owner + "' has " + std::to_string(rules_.max_jobs_per_owner) +
                                       " jobs that have not ended, as many as one may: try again when some have, or "
                                       "raise max_jobs_per_owner");
    }
  }

  // Of everybody where no owner is given.
  std::int64_t count_open(const std::string& owner) {
    std::string sql = "SELECT count(*) FROM job WHERE state IN (";
    for (const JobState state : job_states)
      if (!is_final(state)) sql += (sql.ends_with("(") ? "'" : ",'") + std::string(name(state)) + "'";
    Statement query(database_, sql + (owner.empty() ? ")" : ") AND owner=?"));
    if (!owner.empty()) query.bind(owner);
    query.step();
    return query.number(0);
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

  // A run inside the daemon has ended and the daemon lives.
  static void acquit(JobRecord& job) {
    if (!job.isolated) job.crashes = 0;
  }

  void let_go(JobRow& row) {
    switch (row.job.state) {
      case cancelling:
        return jobs_.move(row, cancelled, "finished");
      case pausing:
        return jobs_.move(row, paused, "interrupted");
      default:
        return jobs_.move(row, queued, "interrupted");
    }
  }

  void end(JobRow& row, const Ending& ending) {
    JobRecord& job = row.job;
    job.error_code = ending.error_code;
    job.error_sentence = ending.error_sentence;
    if (ending.state == succeeded) job.crashes = job.failures = 0;
    if (ending.state == failed && ending.cause != Cause::job) return end_badly(row, ending.cause);
    jobs_.move(row, ending.state, "finished");
    add_artifacts(row.number, ending.artifacts);
  }

  // A failure that is not the job's own: another try, later and in a process of its own after a crash, or no more.
  void end_badly(JobRow& row, Cause cause) {
    JobRecord& job = row.job;
    const bool crash = cause == Cause::crash;
    const int tries = crash ? ++job.crashes : ++job.failures;
    if (tries >= (crash ? rules_.max_crashes : rules_.max_failures)) {
      return jobs_.move(row, crash ? quarantined : failed, crash ? "crashed" : "finished");
    }
    if (job.state == pausing) return jobs_.move(row, paused, crash ? "crashed" : "failed");
    job.wake_at = utc_text(rules_.now_ms() + (rules_.first_backoff_ms << (tries - 1)));
    jobs_.move(row, backoff, crash ? "crashed" : "failed");
  }

  template <typename Act>
  JobState change(const std::string& id, Act act) {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    std::optional<JobRow> row = jobs_.find(id);
    if (!row) refuse_unknown(id);
    act(*row);
    transaction.commit();
    return row->job.state;
  }

  void add_artifacts(std::int64_t job, const std::vector<StoredArtifact>& artifacts) {
    std::int64_t place = 0;
    for (const StoredArtifact& artifact : artifacts) {
      Statement insert(database_, "INSERT INTO artifact VALUES(?,?,?,?,?,?)");
      insert.bind(job).bind(place++).bind(artifact.artifact).bind(artifact.format);
      insert.bind(static_cast<std::int64_t>(artifact.size)).bind(artifact.sha256).run();
    }
  }

  std::mutex mutex_;
  StoreRules rules_;
  Database database_;
  JobTable jobs_;
  std::string epoch_;
  IdMaker ids_;
  std::int64_t last_rank_ms_ = 0;
};

}  // namespace

std::unique_ptr<JobStore> open_sqlite_store(const std::filesystem::path& file, StoreRules rules) {
  return std::make_unique<SqliteStore>(file, std::move(rules));
}

}  // namespace sculpt
