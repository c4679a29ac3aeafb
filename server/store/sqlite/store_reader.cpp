#include "server/store/sqlite/store_reader.hpp"

#include <algorithm>

#include "server/store/sqlite/sqlite_rows.hpp"

namespace sculpt::server {
namespace {

std::optional<JobRecord> record_of(std::optional<JobRow> row) {
  return row ? std::optional(std::move(row->job)) : std::nullopt;
}

// Of the numbers that SQLite has; a greater one is behind all events as well.
std::int64_t within_range(std::uint64_t number) {
  return static_cast<std::int64_t>(std::min<std::uint64_t>(number, INT64_MAX));
}

constexpr const char* events_of_all =
    "SELECT id, seq, event.number, time, data, event.state FROM event CROSS JOIN job ON event.job = job.number "
    "WHERE event.number > ? ORDER BY event.number LIMIT ?";
constexpr const char* events_of_one =
    "SELECT id, seq, event.number, time, data, event.state FROM job CROSS JOIN event ON event.job = job.number "
    "WHERE job.id = ? AND seq > ? ORDER BY seq LIMIT ?";

}  // namespace

std::optional<JobRecord> StoreReader::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return record_of(select_job(database_, "id=?", {id}));
}

std::optional<JobRecord> StoreReader::find_key(const std::string& key) {
  const std::lock_guard lock(mutex_);
  return record_of(select_job(database_, "key=?", {key}));
}

bool StoreReader::was_removed(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return Statement(database_, "SELECT 1 FROM removed WHERE id=?").bind(id).step();
}

JobPage StoreReader::list(const JobWindow& window) {
  std::string rest = "id>?";
  std::vector<std::string> bounds{window.after};
  if (!window.before.empty()) {
    rest += " AND id<?";
    bounds.push_back(window.before);
  }
  const std::lock_guard lock(mutex_);
  return select_page(database_, rest + (window.newest ? " ORDER BY id DESC" : " ORDER BY id"), bounds, window.limit);
}

bool StoreReader::queue_paused() {
  const std::lock_guard lock(mutex_);
  Statement query(database_, "SELECT value FROM meta WHERE name='queue_paused'");
  return query.step() && query.text(0) == "1";
}

std::uint64_t StoreReader::queue_age_s() {
  const std::lock_guard lock(mutex_);
  Statement query(database_, "SELECT max(0, unixepoch() - unixepoch(min(submitted_at))) FROM job WHERE state=?");
  query.bind(name(JobState::queued)).step();
  return static_cast<std::uint64_t>(query.number(0));
}

std::vector<StateEvent> StoreReader::events(const std::string& job, std::uint64_t after, int limit) {
  const std::lock_guard lock(mutex_);
  Statement query(database_, job.empty() ? events_of_all : events_of_one);
  if (!job.empty()) query.bind(job);
  query.bind(within_range(after)).bind(limit);
  std::vector<StateEvent> events;
  while (query.step()) {
    events.push_back({query.text(0), static_cast<std::uint64_t>(query.number(1)),
                      static_cast<std::uint64_t>(query.number(2)), query.text(3), query.text(4),
                      find_state(query.text(5)).value_or(JobState::failed)});
  }
  return events;
}

std::uint64_t StoreReader::last_event(const std::string& job) {
  const std::lock_guard lock(mutex_);
  Statement query(database_, job.empty()
                                 ? "SELECT seq FROM sqlite_sequence WHERE name='event'"
                                 : "SELECT max(seq) FROM event WHERE job = (SELECT number FROM job WHERE id=?)");
  if (!job.empty()) query.bind(job);
  return query.step() ? static_cast<std::uint64_t>(query.number(0)) : 0;
}

std::vector<StoredArtifact> StoreReader::artifacts(const std::string& id) {
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

}  // namespace sculpt::server
