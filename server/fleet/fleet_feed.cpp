#include "server/fleet/fleet_feed.hpp"

#include <utility>

#include "proto/json.hpp"

namespace sculpt::server {
namespace {

constexpr int page = 1000;

// The open jobs one by one, those that have ended by their state; all as of one moment, whose last numbers come first.
constexpr const char* all_jobs =
    "SELECT coalesce(max(number), 0), (SELECT coalesce(max(serial), 0) FROM sculptd.removed), '', '', '', '' "
    "FROM sculptd.event "
    "UNION ALL SELECT 1, rank, id, owner, queue, state FROM sculptd.job WHERE state NOT IN (SELECT unnest($1::text[])) "
    "UNION ALL SELECT count(*), 0, '', '', '', state FROM sculptd.job WHERE state IN (SELECT unnest($1::text[])) "
    "GROUP BY state";
constexpr const char* new_events =
    "SELECT event.number, id, rank, owner, queue, event.state, data FROM sculptd.event JOIN sculptd.job ON event.job = "
    "job.number WHERE event.number > $1 ORDER BY event.number LIMIT $2";
constexpr const char* new_removals =
    "SELECT serial, id, state, first_event FROM sculptd.removed WHERE serial > $1 ORDER BY serial LIMIT $2";

// As PostgreSQL writes an array.
std::string final_states() {
  std::string states;
  for (const JobState state : job_states)
    if (is_final(state)) states += std::string(states.empty() ? "{" : ",") + name(state);
  return states + "}";
}

// Nothing of an event that cannot be read: what is counted may then be wrong by one, but goes on.
std::optional<JobState> from_of(const std::string& data) try {
  const Json json = proto::parse_json(data);
  return json.contains("from") ? find_state(json["from"].get<std::string>()) : std::nullopt;
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace

// A state that nobody knows is not counted.
void FleetFeed::start(Postgres& database) {
  const std::lock_guard lock(mutex_);
  const Answered jobs = database.ask({all_jobs, {sql_value(final_states())}});
  last_event_ = jobs.number(0, 0);
  last_removed_ = jobs.number(0, 1);
  for (int row = 1; row < jobs.rows(); ++row) {
    const std::optional<JobState> state = find_state(jobs.text(row, 5));
    if (!state) continue;
    const std::string id = jobs.text(row, 2);
    const OpenJob job{jobs.number(row, 1), jobs.text(row, 3), jobs.text(row, 4), *state};
    const TallyMove move{job.rank, id, job.owner, job.queue, std::nullopt, state};
    tally_.apply(std::vector(static_cast<std::size_t>(jobs.number(row, 0)), move));
    keep(id, job);
  }
}

void FleetFeed::keep(const std::string& id, const OpenJob& job) {
  is_final(job.state) ? static_cast<void>(open_.erase(id)) : static_cast<void>(open_[id] = job);
  is_active(job.state) ? static_cast<void>(at_work_.insert(id)) : static_cast<void>(at_work_.erase(id));
}

SqlValue FleetFeed::at_work() const {
  const std::lock_guard lock(mutex_);
  std::string ids;
  for (const std::string& id : at_work_) ids += (ids.empty() ? "" : ",") + id;
  return "{" + ids + "}";
}

void FleetFeed::read(Postgres& database) {
  while (true) {
    const std::vector<Answered> answers = database.ask_again(questions());
    if (!take(answers[0], answers[1])) return;
  }
}

std::vector<Question> FleetFeed::questions() const {
  const std::lock_guard lock(mutex_);
  return {{new_events, {sql_value(last_event_), sql_value(page)}},
          {new_removals, {sql_value(last_removed_), sql_value(page)}}};
}

// Another thread may have taken some meanwhile: those are passed over. Removals wait for the events before them.
bool FleetFeed::take(const Answered& events, const Answered& removals) {
  const std::lock_guard lock(mutex_);
  for (int row = 0; row < events.rows(); ++row) count_event(events, row);
  own_.erase(own_.begin(), own_.upper_bound(static_cast<std::uint64_t>(last_event_)));
  if (events.rows() == page) return true;
  for (int row = 0; row < removals.rows(); ++row) count_removal(removals, row);
  return removals.rows() == page;
}

void FleetFeed::count_event(const Answered& events, int row) {
  if (events.number(row, 0) <= last_event_) return;
  const std::string id = events.text(row, 1);
  const std::optional<JobState> to = find_state(events.text(row, 5));
  last_event_ = events.number(row, 0);
  if (!to) return;
  count(id, {events.number(row, 2), events.text(row, 3), events.text(row, 4), *to}, from_of(events.text(row, 6)));
  if (own_.erase(static_cast<std::uint64_t>(last_event_)) == 0) news_.push_back({id, *to});
}

void FleetFeed::count(const std::string& id, const OpenJob& now, std::optional<JobState> known) {
  const auto open = open_.find(id);
  const std::optional<JobState> from = open != open_.end() ? open->second.state : known;
  tally_.apply({{now.rank, id, now.owner, now.queue, from, now.state}});
  keep(id, now);
}

// A job that came and went between two looks was never counted.
void FleetFeed::count_removal(const Answered& removed, int row) {
  if (removed.number(row, 0) <= last_removed_) return;
  last_removed_ = removed.number(row, 0);
  const std::string id = removed.text(row, 1);
  const auto open = open_.find(id);
  const std::optional<JobState> state = open != open_.end() ? open->second.state : find_state(removed.text(row, 2));
  if (!state || removed.number(row, 3) > last_event_) return;
  const OpenJob job = open != open_.end() ? open->second : OpenJob{};
  tally_.apply({{job.rank, id, job.owner, job.queue, state, std::nullopt}});
  open_.erase(id);
}

void FleetFeed::made_here(const std::vector<std::uint64_t>& numbers) {
  const std::lock_guard lock(mutex_);
  for (const std::uint64_t number : numbers)
    if (static_cast<std::int64_t>(number) > last_event_) own_.insert(number);
}

std::vector<FleetNews> FleetFeed::take_news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, {});
}

}  // namespace sculpt::server
