#include "server/fleet/fleet_schema.hpp"

#include <array>

#include "server/base/job_id.hpp"
#include "server/base/storage_error.hpp"
#include "server/base/time_stamp.hpp"

namespace sculpt::server {
namespace {

// Texts that are compared are so by their bytes, on every database. Rows that change often leave room in their page, so
// that a change makes no work for the indexes; what is dead is swept early.
constexpr const char* version_1 = R"(
CREATE TABLE sculptd.meta(name text PRIMARY KEY, value text NOT NULL);
CREATE TABLE sculptd.job(
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  id text COLLATE "C" NOT NULL UNIQUE,
  state text NOT NULL,
  key text UNIQUE,
  priority integer NOT NULL,
  not_before text COLLATE "C" NOT NULL,
  start_by text COLLATE "C" NOT NULL,
  max_runtime_s bigint NOT NULL,
  spec text NOT NULL,
  cell_bundle text NOT NULL,
  memory_bytes bigint NOT NULL,
  rank bigint NOT NULL,
  attempt integer NOT NULL DEFAULT 0,
  failures integer NOT NULL DEFAULT 0,
  crashes integer NOT NULL DEFAULT 0,
  isolated boolean NOT NULL DEFAULT false,
  wake_at text COLLATE "C" NOT NULL,
  submitted_at text COLLATE "C" NOT NULL,
  started_at text NOT NULL DEFAULT '',
  finished_at text NOT NULL DEFAULT '',
  error_code text NOT NULL DEFAULT '',
  error_sentence text NOT NULL DEFAULT '',
  pinned boolean NOT NULL DEFAULT false,
  owner text NOT NULL,
  inherited text NOT NULL
) WITH (fillfactor=80, autovacuum_vacuum_scale_factor=0.01, autovacuum_vacuum_threshold=500,
        autovacuum_vacuum_cost_delay=0);
CREATE INDEX job_queue ON sculptd.job(rank, number) WHERE state='queued';
CREATE INDEX job_waiting ON sculptd.job(wake_at) WHERE state IN ('held', 'backoff');
CREATE INDEX job_start_by ON sculptd.job(start_by)
  WHERE start_by<>'' AND attempt=0 AND state IN ('held', 'queued');
CREATE TABLE sculptd.lease(
  job bigint PRIMARY KEY REFERENCES sculptd.job ON DELETE CASCADE,
  daemon text NOT NULL,
  attempt integer NOT NULL,
  until timestamptz NOT NULL,
  progress text NOT NULL DEFAULT ''
) WITH (fillfactor=70, autovacuum_vacuum_scale_factor=0.01, autovacuum_vacuum_threshold=100,
        autovacuum_vacuum_cost_delay=0);
CREATE SEQUENCE sculptd.event_number;
CREATE TABLE sculptd.event(
  number bigint PRIMARY KEY,
  job bigint NOT NULL REFERENCES sculptd.job,
  seq bigint NOT NULL,
  time text NOT NULL,
  state text NOT NULL,
  data text NOT NULL,
  UNIQUE(job, seq));
CREATE TABLE sculptd.artifact(
  job bigint NOT NULL REFERENCES sculptd.job,
  place integer NOT NULL,
  artifact text NOT NULL,
  format text NOT NULL,
  size bigint NOT NULL,
  sha256 text NOT NULL,
  PRIMARY KEY(job, place));
CREATE TABLE sculptd.removed(
  id text COLLATE "C" PRIMARY KEY,
  serial bigint GENERATED ALWAYS AS IDENTITY UNIQUE,
  state text NOT NULL,
  first_event bigint NOT NULL,
  last_event bigint NOT NULL);
CREATE INDEX removed_last ON sculptd.removed(last_event);
CREATE TABLE sculptd.daemon(
  id text PRIMARY KEY,
  address text NOT NULL,
  version text NOT NULL,
  schema integer NOT NULL,
  workers integer NOT NULL,
  running integer NOT NULL,
  memory_bytes bigint NOT NULL,
  seen timestamptz NOT NULL
) WITH (fillfactor=70);
)";

constexpr const char* version_2 = R"(
ALTER TABLE sculptd.job ADD COLUMN queue text NOT NULL DEFAULT 'default';
DROP INDEX sculptd.job_queue;
CREATE INDEX job_queue ON sculptd.job(queue, rank, number) WHERE state='queued';
CREATE INDEX job_age ON sculptd.job(submitted_at) WHERE state='queued';
ALTER TABLE sculptd.daemon ADD COLUMN queues jsonb NOT NULL DEFAULT '["default"]';
CREATE TABLE sculptd.file(
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  path text COLLATE "C" NOT NULL UNIQUE,
  job bigint REFERENCES sculptd.job ON DELETE SET NULL,
  size bigint NOT NULL DEFAULT 0,
  used timestamptz NOT NULL DEFAULT now()
) WITH (fillfactor=70);
CREATE INDEX file_job ON sculptd.file(job);
CREATE TABLE sculptd.piece(
  file bigint NOT NULL REFERENCES sculptd.file ON DELETE CASCADE,
  at bigint NOT NULL,
  bytes bytea NOT NULL,
  PRIMARY KEY(file, at));
ALTER TABLE sculptd.piece ALTER bytes SET STORAGE EXTERNAL;
)";

// An index over a million jobs is made in seconds, on a slow disk in minutes.
constexpr std::chrono::minutes schema_patience{10};

constexpr std::array<const char*, fleet_schema_version> steps{version_1, version_2};

std::int64_t read_version(Postgres& database) {
  // By a look at the rows: what to_regclass remembers may be older than the lock.
  const Question there{
      "SELECT EXISTS(SELECT 1 FROM pg_catalog.pg_tables WHERE schemaname='sculptd' AND tablename='meta')"};
  if (!database.ask(there).flag(0, 0)) return 0;
  const Answered version = database.ask({"SELECT value FROM sculptd.meta WHERE name='schema'"});
  return version.rows() == 0 ? 0 : version.number(0, 0);
}

void refuse_newer(std::int64_t version) {
  if (version <= fleet_schema_version) return;
  throw StorageError("the tables of the database are of version " + std::to_string(version) +
                     ", and this sculptd knows only version " + std::to_string(fleet_schema_version) +
                     ": start a newer sculptd");
}

// As one script, which is one transaction: whoever comes second waits, and finds the work done.
std::string update_script(std::int64_t version) {
  std::string script;
  if (version == 0) script += "CREATE SCHEMA IF NOT EXISTS sculptd;";
  for (auto step = static_cast<std::size_t>(version); step < steps.size(); ++step) script += steps[step];
  if (version == 0) script += "INSERT INTO sculptd.meta VALUES('epoch', '" + IdMaker().next(unix_ms()) + "');";
  return script + "INSERT INTO sculptd.meta VALUES('schema', '" + std::to_string(fleet_schema_version) +
         "') ON CONFLICT(name) DO UPDATE SET value=excluded.value;";
}

}  // namespace

SqlValue sql_value(FleetLock lock) {
  return sql_value(static_cast<std::int64_t>(lock));
}

void update_fleet_schema(const PostgresSource& source) {
  Postgres database(source, schema_patience);
  const std::int64_t found = read_version(database);
  refuse_newer(found);
  if (found == fleet_schema_version) return;
  database.ask({"BEGIN"});
  database.ask({"SELECT pg_advisory_xact_lock($1)", {sql_value(FleetLock::schema)}});
  const std::int64_t version = read_version(database);
  try {
    refuse_newer(version);
    // Somebody's open transaction may hold a table, and all daemons would wait behind this.
    if (version < fleet_schema_version) database.run("SET LOCAL lock_timeout='5s';" + update_script(version));
    database.ask({"COMMIT"});
  } catch (...) {
    database.drop();
    throw;
  }
}

void grant_to_daemons(const PostgresSource& source, const std::string& role) {
  Postgres database(source, schema_patience);
  const std::string name = database.ask({"SELECT quote_ident($1)", {sql_value(role)}}).text(0, 0);
  database.run("GRANT USAGE ON SCHEMA sculptd TO " + name +
               "; GRANT SELECT, INSERT, UPDATE, DELETE ON ALL TABLES IN SCHEMA sculptd TO " + name +
               "; GRANT USAGE ON ALL SEQUENCES IN SCHEMA sculptd TO " + name + ";");
}

}  // namespace sculpt::server
