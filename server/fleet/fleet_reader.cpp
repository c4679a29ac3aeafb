#include "server/fleet/fleet_reader.hpp"

#include <algorithm>

#include "proto/json.hpp"
#include "server/fleet/fleet_rows.hpp"
#include "server/store/job_columns.hpp"

namespace sculpt::server {
namespace {

constexpr std::chrono::seconds read_patience{10};
const std::string from_job = std::string("SELECT ") + job_columns + " FROM sculptd.job ";

// Of the numbers that the database has; a greater one is behind all events as well.
SqlValue within_range(std::uint64_t number) {
  return sql_value(static_cast<std::int64_t>(std::min<std::uint64_t>(number, INT64_MAX)));
}

std::optional<JobRecord> first_record(const Answered& answer) {
  return answer.rows() == 0 ? std::nullopt : std::optional(read_fleet_row(answer, 0).job);
}

constexpr const char* events_of_all =
    "SELECT id, seq, event.number, time, data, event.state FROM sculptd.event JOIN sculptd.job ON event.job = "
    "job.number WHERE event.number > $1 ORDER BY event.number LIMIT $2";
constexpr const char* events_of_one =
    "SELECT id, seq, event.number, time, data, event.state FROM sculptd.event JOIN sculptd.job ON event.job = "
    "job.number WHERE seq > $1 AND job.id = $3 ORDER BY seq LIMIT $2";
constexpr const char* last_of_all =
    "SELECT greatest((SELECT max(number) FROM sculptd.event), (SELECT max(last_event) FROM sculptd.removed))";
constexpr const char* last_of_one =
    "SELECT max(seq) FROM sculptd.event WHERE job = (SELECT number FROM sculptd.job WHERE id=$1)";

}  // namespace

FleetReader::FleetReader(const PostgresSource& source) : database_(source, read_patience) {}

Answered FleetReader::ask(const Question& question) {
  const std::lock_guard lock(mutex_);
  return database_.ask_again({question}).front();
}

std::string FleetReader::epoch() {
  const Answered answer = ask({"SELECT value FROM sculptd.meta WHERE name='epoch'"});
  return answer.rows() == 0 ? "" : answer.text(0, 0);
}

std::optional<JobRecord> FleetReader::find(const std::string& id) {
  return first_record(ask({from_job + "WHERE id=$1", {sql_value(id)}}));
}

std::optional<JobRecord> FleetReader::find_key(const std::string& key) {
  return first_record(ask({from_job + "WHERE key=$1", {sql_value(key)}}));
}

bool FleetReader::was_removed(const std::string& id) {
  return ask({"SELECT 1 FROM sculptd.removed WHERE id=$1", {sql_value(id)}}).rows() > 0;
}

// A row that cannot be read takes no place, so one that is left over says nothing of those behind it.
JobPage FleetReader::list(const JobWindow& window) {
  JobPage page;
  std::string after = window.after, before = window.before;
  const int wanted = window.limit + 1;
  while (true) {
    const std::string bounds = "WHERE id > $1 AND ($2 = '' OR id < $2) ORDER BY id";
    const Answered answer = ask({from_job + bounds + (window.newest ? " DESC" : "") + " LIMIT $3",
                                 {sql_value(after), sql_value(before), sql_value(wanted)}});
    for (int row = 0; row < answer.rows(); ++row) {
      if (page.jobs.size() == static_cast<std::size_t>(window.limit)) {
        page.more = true;
        return page;
      }
      try {
        page.jobs.push_back(read_fleet_row(answer, row).job);
      } catch (const StorageError& error) {
        page.damaged.push_back({answer.text(row, id_column), error.what()});
      }
    }
    if (answer.rows() < wanted) return page;
    (window.newest ? before : after) = answer.text(answer.rows() - 1, id_column);
  }
}

bool FleetReader::queue_paused() {
  const Answered answer = ask({"SELECT value FROM sculptd.meta WHERE name='queue_paused'"});
  return answer.rows() > 0 && answer.text(0, 0) == "1";
}

std::uint64_t FleetReader::queue_age_s() {
  const Answered answer =
      ask({"SELECT floor(extract(epoch FROM now() - min(submitted_at)::timestamptz))::bigint FROM sculptd.job "
           "WHERE state='queued'"});
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, answer.number(0, 0)));
}

std::vector<StateEvent> FleetReader::events(const std::string& job, std::uint64_t after, int limit) {
  Question question{job.empty() ? events_of_all : events_of_one, {within_range(after), sql_value(limit)}};
  if (!job.empty()) question.values.push_back(sql_value(job));
  const Answered answer = ask(question);
  std::vector<StateEvent> events;
  for (int row = 0; row < answer.rows(); ++row) {
    events.push_back({answer.text(row, 0), static_cast<std::uint64_t>(answer.number(row, 1)),
                      static_cast<std::uint64_t>(answer.number(row, 2)), answer.text(row, 3), answer.text(row, 4),
                      find_state(answer.text(row, 5)).value_or(JobState::failed)});
  }
  return events;
}

std::uint64_t FleetReader::last_event(const std::string& job) {
  const Answered answer = job.empty() ? ask({last_of_all}) : ask({last_of_one, {sql_value(job)}});
  return static_cast<std::uint64_t>(answer.number(0, 0));
}

std::vector<StoredArtifact> FleetReader::artifacts(const std::string& id) {
  const Answered answer =
      ask({"SELECT artifact, format, size, sha256 FROM sculptd.artifact JOIN sculptd.job ON artifact.job = "
           "job.number WHERE job.id=$1 ORDER BY place",
           {sql_value(id)}});
  std::vector<StoredArtifact> artifacts;
  for (int row = 0; row < answer.rows(); ++row)
    artifacts.push_back({answer.text(row, 0), answer.text(row, 1), static_cast<std::uint64_t>(answer.number(row, 2)),
                         answer.text(row, 3)});
  return artifacts;
}

std::vector<FleetDaemon> FleetReader::daemons() {
  const Answered answer =
      ask({"SELECT id, address, version, workers, running, memory_bytes, queues, extract(epoch FROM now() - seen) FROM "
           "sculptd.daemon WHERE seen > now() - interval '1 hour' ORDER BY address, id"});
  std::vector<FleetDaemon> daemons;
  for (int row = 0; row < answer.rows(); ++row)
    daemons.push_back({answer.text(row, 0), answer.text(row, 1), answer.text(row, 2),
                       static_cast<int>(answer.number(row, 3)), static_cast<int>(answer.number(row, 4)),
                       static_cast<std::uint64_t>(answer.number(row, 5)), proto::parse_json(answer.text(row, 6)),
                       std::stod(answer.text(row, 7))});
  return daemons;
}

}  // namespace sculpt::server
