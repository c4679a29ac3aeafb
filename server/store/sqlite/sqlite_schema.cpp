#include "server/store/sqlite/sqlite_schema.hpp"

#include <array>

#include "server/base/job_id.hpp"
#include "server/store/job_store.hpp"

namespace sculpt::server {
namespace {

constexpr const char* version_1 = R"(
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

// What a version-1 daemon left running ran inside it when it died: a crash, as claim counts it since.
constexpr const char* version_2 = R"(
ALTER TABLE job ADD COLUMN not_before TEXT NOT NULL DEFAULT '';
ALTER TABLE job ADD COLUMN start_by TEXT NOT NULL DEFAULT '';
ALTER TABLE job ADD COLUMN max_runtime_s INTEGER NOT NULL DEFAULT 0;
ALTER TABLE job ADD COLUMN memory_bytes INTEGER NOT NULL DEFAULT 0;
ALTER TABLE job ADD COLUMN rank INTEGER NOT NULL DEFAULT 0;
ALTER TABLE job ADD COLUMN failures INTEGER NOT NULL DEFAULT 0;
ALTER TABLE job ADD COLUMN crashes INTEGER NOT NULL DEFAULT 0;
ALTER TABLE job ADD COLUMN isolated INTEGER NOT NULL DEFAULT 0;
ALTER TABLE job ADD COLUMN wake_at TEXT NOT NULL DEFAULT '';
UPDATE job SET rank = 1000 * CAST(strftime('%s', submitted_at) AS INTEGER) + CAST(substr(submitted_at, 21, 3) AS INTEGER)
                      - 60000 * priority;
UPDATE job SET crashes = 1 WHERE state IN ('running', 'cancelling');
DROP INDEX job_queue;
CREATE INDEX job_queue ON job(state, rank, number);
CREATE INDEX job_start_by ON job(start_by) WHERE start_by <> '';
)";

constexpr const char* version_3 = R"(
ALTER TABLE job ADD COLUMN pinned INTEGER NOT NULL DEFAULT 0;
ALTER TABLE job ADD COLUMN owner TEXT NOT NULL DEFAULT '';
CREATE INDEX job_owner ON job(owner, state);
CREATE TABLE removed(id TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
)";

// Events get a number among those of all jobs. Those that are there are numbered by time, but never against the order
// of their job, should the clock have been set back.
constexpr const char* version_4 = R"(
CREATE TABLE numbered(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  job INTEGER NOT NULL REFERENCES job(number),
  seq INTEGER NOT NULL,
  time TEXT NOT NULL,
  state TEXT NOT NULL,
  data TEXT NOT NULL,
  UNIQUE(job, seq)) STRICT;
INSERT INTO numbered(job, seq, time, state, data)
  SELECT job, seq, time, state, data FROM event ORDER BY max(time) OVER (PARTITION BY job ORDER BY seq), job, seq;
DROP TABLE event;
ALTER TABLE numbered RENAME TO event;
)";

constexpr const char* version_5 = R"(
ALTER TABLE job ADD COLUMN inherited TEXT NOT NULL DEFAULT '';
)";

constexpr const char* version_6 = R"(
ALTER TABLE job ADD COLUMN queue TEXT NOT NULL DEFAULT 'default';
)";

constexpr std::array<const char*, schema_version> steps{version_1, version_2, version_3,
                                                        version_4, version_5, version_6};

std::int64_t read_version(Database& database) {
  Statement query(database, "PRAGMA user_version");
  query.step();
  return query.number(0);
}

}  // namespace

void update_schema(Database& database, const std::filesystem::path& file) {
  Transaction transaction(database);
  const std::int64_t version = read_version(database);
  if (version > schema_version) {
    throw StorageError("the database '" + file.string() + "' was made by a newer sculptd: use that one");
  }
  for (auto step = static_cast<std::size_t>(version); step < steps.size(); ++step) database.run(steps[step]);
  if (version == 0) Statement(database, "INSERT INTO meta VALUES('epoch', ?)").bind(IdMaker().next(unix_ms())).run();
  database.run(("PRAGMA user_version=" + std::to_string(schema_version)).c_str());
  transaction.commit();
}

}  // namespace sculpt::server
