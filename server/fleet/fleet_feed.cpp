#include "server/fleet/fleet_feed.hpp"

#include <utility>

#include "proto/json.hpp"

namespace sculpt::server {
namespace {

constexpr int page = 1000;

// A state that nobody knows is not counted.
constexpr const char* all_jobs =
    "SELECT rank, id, owner, state, (SELECT coalesce(max(number), 0) FROM sculptd.event), "
    "(SELECT coalesce(max(serial), 0) FROM sculptd.removed) FROM sculptd.job "
    "UNION ALL SELECT 0, '', '', '', (SELECT coalesce(max(number), 0) FROM sculptd.event), "
    "(SELECT coalesce(max(serial), 0) FROM sculptd.removed)";
constexpr const char* new_events =
    "SELECT event.number, id, rank, owner, event.state, data FROM sculptd.event JOIN sculptd.job ON event.job = "
    "job.number WHERE event.number > $1 ORDER BY event.number LIMIT $2";
constexpr const char* new_removals =
    "SELECT serial, id, state, first_event FROM sculptd.removed WHERE serial > $1 ORDER BY serial LIMIT $2";

// Nothing of an event that cannot be read: what is counted may then be wrong by one, but goes on.
std::optional<JobState> from_of(const std::string& data) try {
  const Json json = proto::parse_json(data);
  return json.contains("from") ? find_state(json["from"].get<std::string>()) : std::nullopt;
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace

void FleetFeed::start(Postgres& database) {
  const std::lock_guard lock(mutex_);
  const Answered jobs = database.ask({all_jobs});
  std::vector<TallyMove> moves;
  for (int row = 0; row < jobs.rows(); ++row) {
    last_event_ = jobs.number(row, 4);
    last_removed_ = jobs.number(row, 5);
    const std::optional<JobState> state = find_state(jobs.text(row, 3));
    if (!state) continue;
    const OpenJob job{jobs.number(row, 0), jobs.text(row, 2), *state};
    moves.push_back({job.rank, jobs.text(row, 1), job.owner, std::nullopt, state});
    if (!is_final(*state)) open_[jobs.text(row, 1)] = job;
  }
  tally_.apply(moves);
}

void FleetFeed::read(Postgres& database) {
  while (true) {
    const std::vector<Answered> answers = database.ask_again(questions());
    take(answers[0], answers[1]);
    if (answers[0].rows() < page && answers[1].rows() < page) return;
  }
}

std::vector<Question> FleetFeed::questions() const {
  const std::lock_guard lock(mutex_);
  return {{new_events, {sql_value(last_event_), sql_value(page)}},
          {new_removals, {sql_value(last_removed_), sql_value(page)}}};
}

// Another thread may have taken some meanwhile: those are passed over. Removals wait for the events before them.
void FleetFeed::take(const Answered& events, const Answered& removals) {
  const std::lock_guard lock(mutex_);
  for (int row = 0; row < events.rows(); ++row) count_event(events, row);
  own_.erase(own_.begin(), own_.upper_bound(static_cast<std::uint64_t>(last_event_)));
  if (events.rows() == page) return;
  for (int row = 0; row < removals.rows(); ++row) count_removal(removals, row);
}

void FleetFeed::count_event(const Answered& events, int row) {
  if (events.number(row, 0) <= last_event_) return;
  const std::string id = events.text(row, 1);
  const std::optional<JobState> to = find_state(events.text(row, 4));
  last_event_ = events.number(row, 0);
  if (!to) return;
  count(id, {events.number(row, 2), events.text(row, 3), *to}, from_of(events.text(row, 5)));
  if (own_.erase(static_cast<std::uint64_t>(last_event_)) == 0) news_.push_back({id, *to});
}

void FleetFeed::count(const std::string& id, const OpenJob& now, std::optional<JobState> known) {
  const auto open = open_.find(id);
  const std::optional<JobState> from = open != open_.end() ? open->second.state : known;
  tally_.apply({{now.rank, id, now.owner, from, now.state}});
  if (is_final(now.state))
    open_.erase(id);
  else
    open_[id] = now;
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
  tally_.apply({{job.rank, id, job.owner, state, std::nullopt}});
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
