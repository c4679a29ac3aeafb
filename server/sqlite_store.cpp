// The job store in SQLite: WAL, synchronous=FULL, so that a returned call survives a killed daemon and a power cut.
#include <mutex>

#include "proto/error_codes.hpp"
#include "server/job_id.hpp"
#include "server/job_store.hpp"
#include "server/sqlite.hpp"
#include "server/time_stamp.hpp"

namespace sculpt {
namespace {

constexpr std::int64_t schema_version = 1;

constexpr const char* schema = R"(
CREATE TABLE meta(name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
CREATE TABLE job(
  number INTEGER PRIMARY KEY,
  id TEXT NOT NULL UNIQUE,
  state TEXT NOT NULL,
  key TEXT UNIQUE,
  priority INTEGER NOT NULL,
  spec TEXT NOT NULL,
  cell_bundle TEXT NOT NULL,
  attempt INTEGER NOT NULL DEFAULT 0,
  submitted_at TEXT NOT NULL,
  started_at TEXT NOT NULL DEFAULT '',
  finished_at TEXT NOT NULL DEFAULT '',
  error_code TEXT NOT NULL DEFAULT '',
  error_sentence TEXT NOT NULL DEFAULT '') STRICT;
CREATE INDEX job_queue ON job(state, priority DESC, number);
CREATE TABLE event(
  job INTEGER NOT NULL REFERENCES job(number),
  seq INTEGER NOT NULL,
  time TEXT NOT NULL,
  state TEXT NOT NULL,
  data TEXT NOT NULL,
  PRIMARY KEY(job, seq)) STRICT, WITHOUT ROWID;
CREATE TABLE artifact(
  job INTEGER NOT NULL REFERENCES job(number),
  place INTEGER NOT NULL,
  artifact TEXT NOT NULL,
  format TEXT NOT NULL,
  size INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  PRIMARY KEY(job, place)) STRICT, WITHOUT ROWID;
)";

constexpr const char* job_columns =
    "id, state, key, priority, spec, cell_bundle, attempt, submitted_at, started_at, finished_at, error_code, "
    "error_sentence, number";
constexpr int number_column = 12;

struct NumberedJob {
  JobRecord job;
  std::int64_t number = 0;
};

NumberedJob read_job(const Statement& row) {
  NumberedJob read;
  JobRecord& job = read.job;
  job.id = row.text(0);
  const std::optional<JobState> state = find_state(row.text(1));
  if (!state) throw StorageError("job " + job.id + " has the unknown state '" + row.text(1) + "' in the database");
  job.state = *state;
  job.key = row.text(2);
  job.priority = static_cast<int>(row.number(3));
  job.spec = row.text(4);
  job.cell_bundle = row.text(5);
  job.attempt = static_cast<int>(row.number(6));
  job.submitted_at = row.text(7);
  job.started_at = row.text(8);
  job.finished_at = row.text(9);
  job.error_code = row.text(10);
  job.error_sentence = row.text(11);
  read.number = row.number(number_column);
  return read;
}

class SqliteStore : public JobStore {
 public:
  explicit SqliteStore(const std::filesystem::path& file) : database_(file) {
    database_.run("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON;");
    database_.run("PRAGMA journal_size_limit=67108864;");
    create_schema(file);
    epoch_ = read_text("SELECT value FROM meta WHERE name='epoch'");
    ids_ = IdMaker(read_text("SELECT max(id) FROM job"));
  }

  std::string epoch() override { return epoch_; }

  Submitted submit(const NewJob& wanted) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    if (std::optional<NumberedJob> first = find_where("key", wanted.key); first && !wanted.key.empty()) {
      if (first->job.spec != wanted.spec) {
        throw ProtocolError("key_conflict",
                            "the key '" + wanted.key + "' belongs to job " + first->job.id +
                                ", which has another spec: use a new key for a new job",
                            "/params/key");
      }
      return {first->job, true};
    }
    const std::uint64_t now = unix_ms();
    const std::string id = ids_.next(now);
    Statement insert(
        database_, "INSERT INTO job(id, state, key, priority, spec, cell_bundle, submitted_at) VALUES(?,?,?,?,?,?,?)");
    insert.bind(id).bind(name(JobState::queued));
    wanted.key.empty() ? insert.bind_null() : insert.bind(wanted.key);
    insert.bind(wanted.priority).bind(wanted.spec).bind(wanted.cell_bundle).bind(utc_text(now)).run();
    NumberedJob job = *find_where("id", id);
    add_event(job, {{"to", name(JobState::queued)}, {"reason", "submitted"}});
    transaction.commit();
    return {job.job, false};
  }

  std::optional<JobRecord> claim() override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    std::optional<NumberedJob> best;
    {
      Statement query(database_, std::string("SELECT ") + job_columns +
                                     " FROM job WHERE state='queued' ORDER BY priority DESC, number LIMIT 1");
      if (!query.step()) return std::nullopt;
      best = read_job(query);
    }
    move(*best, JobState::running, "claimed");
    transaction.commit();
    return best->job;
  }

  bool finish(const std::string& id, int attempt, const Ending& ending) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    std::optional<NumberedJob> job = find_where("id", id);
    if (!job || !owned(job->job, attempt)) return false;
    if (job->job.state == JobState::cancelling) {
      move(*job, JobState::cancelled, "finished");
    } else {
      job->job.error_code = ending.error_code;
      job->job.error_sentence = ending.error_sentence;
      move(*job, ending.state, "finished");
      add_artifacts(*job, ending.artifacts);
    }
    transaction.commit();
    return true;
  }

  bool release(const std::string& id, int attempt) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    std::optional<NumberedJob> job = find_where("id", id);
    if (!job || !owned(job->job, attempt)) return false;
    let_go(*job);
    transaction.commit();
    return true;
  }

  JobState cancel(const std::string& id) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    std::optional<NumberedJob> job = find_where("id", id);
    if (!job) throw ProtocolError("not_found", "there is no job '" + id + "'", "/params/job");
    const JobState state = job->job.state;
    if (state == JobState::cancelled || state == JobState::cancelling) return state;
    if (is_final(state)) {
      throw ProtocolError("wrong_state", "job " + id + " has already " + name(state) + " and cannot be cancelled");
    }
    move(*job, state == JobState::queued ? JobState::cancelled : JobState::cancelling, "cancel_requested");
    transaction.commit();
    return job->job.state;
  }

  int recover() override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(database_);
    std::vector<NumberedJob> left;
    {
      Statement query(database_, std::string("SELECT ") + job_columns +
                                     " FROM job WHERE state IN ('running','cancelling') ORDER BY number");
      while (query.step()) left.push_back(read_job(query));
    }
    for (NumberedJob& job : left) let_go(job);
    transaction.commit();
    return static_cast<int>(left.size());
  }

  std::optional<JobRecord> find(const std::string& id) override {
    const std::lock_guard lock(mutex_);
    const std::optional<NumberedJob> job = find_where("id", id);
    return job ? std::optional(job->job) : std::nullopt;
  }

  std::optional<JobRecord> find_key(const std::string& key) override {
    const std::lock_guard lock(mutex_);
    const std::optional<NumberedJob> job = find_where("key", key);
    return job ? std::optional(job->job) : std::nullopt;
  }

  std::vector<JobRecord> list(const std::string& after, int limit) override {
    const std::lock_guard lock(mutex_);
    Statement query(database_, std::string("SELECT ") + job_columns + " FROM job WHERE id > ? ORDER BY id LIMIT ?");
    query.bind(after).bind(limit);
    std::vector<JobRecord> jobs;
    while (query.step()) jobs.push_back(read_job(query).job);
    return jobs;
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
                    "SELECT count(*) FROM job WHERE state='queued' AND (priority > ? OR (priority = ? AND id < ?))");
    query.bind(job.priority).bind(job.priority).bind(job.id).step();
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
      events.push_back({seq, query.text(1), query.text(2), find_state(query.text(3)).value_or(JobState::failed)});
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
  void create_schema(const std::filesystem::path& file) {
    Transaction transaction(database_);
    std::int64_t version = 0;
    {
      Statement query(database_, "PRAGMA user_version");
      query.step();
      version = query.number(0);
    }
    if (version > schema_version) {
      throw StorageError("the database '" + file.string() + "' was made by a newer sculptd: use that one");
    }
    if (version == 0) {
      database_.run(schema);
      Statement(database_, "INSERT INTO meta VALUES('epoch', ?)").bind(IdMaker().next(unix_ms())).run();
      database_.run("PRAGMA user_version=1");
    }
    transaction.commit();
  }

  std::string read_text(const char* sql) {
    Statement query(database_, sql);
    return query.step() ? query.text(0) : std::string();
  }

  std::optional<NumberedJob> find_where(const std::string& column, const std::string& value) {
    Statement query(database_, std::string("SELECT ") + job_columns + " FROM job WHERE " + column + "=?");
    query.bind(value);
    return query.step() ? std::optional(read_job(query)) : std::nullopt;
  }

  static bool owned(const JobRecord& job, int attempt) {
    return job.attempt == attempt && (job.state == JobState::running || job.state == JobState::cancelling);
  }

  void let_go(NumberedJob& job) {
    const bool cancelling = job.job.state == JobState::cancelling;
    move(job, cancelling ? JobState::cancelled : JobState::queued, cancelling ? "finished" : "interrupted");
  }

  // The only place where a state changes. The row must still be as it was read: anything else is a fault, not a shrug.
  void move(NumberedJob& numbered, JobState to, const char* reason) {
    JobRecord& job = numbered.job;
    const JobState from = job.state;
    if (!may_move(from, to)) {
      throw std::logic_error(std::string("job ") + job.id + " may not go from " + name(from) + " to " + name(to));
    }
    const std::string now = utc_text(unix_ms());
    if (to == JobState::running) {
      job.started_at = now;
      ++job.attempt;
    }
    if (is_final(to)) job.finished_at = now;
    Statement update(database_,
                     "UPDATE job SET state=?, attempt=?, started_at=?, finished_at=?, error_code=?, error_sentence=? "
                     "WHERE number=? AND state=?");
    update.bind(name(to)).bind(job.attempt).bind(job.started_at).bind(job.finished_at).bind(job.error_code);
    update.bind(job.error_sentence).bind(numbered.number).bind(name(from));
    if (update.run() != 1) throw StorageError("job " + job.id + " changed under the hands of the store");
    job.state = to;
    Json data{{"from", name(from)}, {"to", name(to)}};
    if (job.attempt > 0) data["attempt"] = job.attempt;
    data["reason"] = reason;
    if (to == JobState::failed) data["error"] = {{"code", job.error_code}, {"message", job.error_sentence}};
    add_event(numbered, data);
  }

  void add_event(const NumberedJob& job, const Json& data) {
    Statement insert(database_,
                     "INSERT INTO event(job, seq, time, state, data) "
                     "SELECT ?1, coalesce(max(seq), 0) + 1, ?2, ?3, ?4 FROM event WHERE job = ?1");
    insert.bind(job.number).bind(utc_text(unix_ms())).bind(name(job.job.state)).bind(write_json(data)).run();
  }

  void add_artifacts(const NumberedJob& job, const std::vector<StoredArtifact>& artifacts) {
    std::int64_t place = 0;
    for (const StoredArtifact& artifact : artifacts) {
      Statement insert(database_, "INSERT INTO artifact VALUES(?,?,?,?,?,?)");
      insert.bind(job.number).bind(place++).bind(artifact.artifact).bind(artifact.format);
      insert.bind(static_cast<std::int64_t>(artifact.size)).bind(artifact.sha256).run();
    }
  }

  std::mutex mutex_;
  Database database_;
  std::string epoch_;
  IdMaker ids_;
};

}  // namespace

std::unique_ptr<JobStore> open_sqlite_store(const std::filesystem::path& file) {
  return std::make_unique<SqliteStore>(file);
}

}  // namespace sculpt
