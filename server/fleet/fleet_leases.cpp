#include "server/fleet/fleet_leases.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "proto/json.hpp"
#include "proto/version.hpp"
#include "server/base/progress_text.hpp"
#include "server/base/storage_error.hpp"
#include "server/base/time_stamp.hpp"
#include "server/fleet/fleet_schema.hpp"

namespace sculpt::server {
namespace {

constexpr std::chrono::milliseconds max_beat{2000};
constexpr std::uint64_t beats_per_measure = 10;
constexpr double long_transaction_s = 300;

// A run is told to end so long before others may take its job.
std::chrono::milliseconds margin(std::chrono::milliseconds lease) {
  return lease / 6;
}

std::int64_t steady_ms() {
  const auto now = FleetLeases::Clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

constexpr const char* renew_leases =
    "UPDATE sculptd.lease SET until = now() + $2 * interval '1 ms', progress = mine.progress "
    "FROM jsonb_to_recordset($3::jsonb) AS mine(id text, attempt integer, progress text), sculptd.job "
    "WHERE job.id = mine.id AND lease.job = job.number AND lease.attempt = mine.attempt AND lease.daemon = $1 "
    "RETURNING job.id";
constexpr const char* say_hello =
    "INSERT INTO sculptd.daemon VALUES($1, $2, $3, $4, $5, $6, $7, now(), $8) ON CONFLICT(id) DO UPDATE SET "
    "address=excluded.address, version=excluded.version, schema=excluded.schema, workers=excluded.workers, "
    "running=excluded.running, memory_bytes=excluded.memory_bytes, seen=excluded.seen, "
    "queues=excluded.queues RETURNING floor(extract(epoch FROM now()) * 1000)::bigint";
constexpr const char* look_at_trouble =
    "SELECT coalesce(extract(epoch FROM (SELECT max(now() - xact_start) FROM pg_stat_activity)), 0), "
    "coalesce((SELECT n_dead_tup FROM pg_stat_user_tables WHERE schemaname='sculptd' AND relname='job'), 0)";

}  // namespace

FleetLeases::FleetLeases(const PostgresSource& source, FleetMember member, std::chrono::milliseconds lease)
    : database_(source, margin(lease)),
      member_(std::move(member)),
      lease_(lease),
      beat_(std::min(max_beat, lease / 10)),
      ahead_ms_(static_cast<std::int64_t>(unix_ms()) - steady_ms()) {}

void FleetLeases::start(const FleetHooks& hooks, const std::string& address) {
  hooks_ = hooks;
  address_ = address;
  renewing_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  minding_ = std::jthread([this](const std::stop_token& stop) { mind(stop); });
}

void FleetLeases::stop() {
  for (std::jthread* thread : {&renewing_, &minding_}) {
    thread->request_stop();
    if (thread->joinable()) thread->join();
  }
}

void FleetLeases::hold(const JobRecord& job, Clock::time_point since) {
  const std::lock_guard lock(mutex_);
  held_[job.id] = {job.attempt, job.memory_bytes, job.isolated && job.crashes > 0, since + lease_ - margin(lease_)};
}

void FleetLeases::let_go_all() {
  const std::lock_guard lock(mutex_);
  held_.clear();
}

bool FleetLeases::holds(const std::string& job) const {
  const std::lock_guard lock(mutex_);
  return held_.contains(job);
}

AtWork FleetLeases::at_work() const {
  const std::lock_guard lock(mutex_);
  AtWork sum;
  for (const auto& [job, held] : held_) {
    ++sum.jobs;
    sum.memory_bytes += held.memory_bytes;
    sum.suspect |= held.suspect;
  }
  return sum;
}

void FleetLeases::let_go(const std::string& job, int attempt) {
  const std::lock_guard lock(mutex_);
  if (const auto found = held_.find(job); found != held_.end() && found->second.attempt == attempt) held_.erase(found);
}

std::uint64_t FleetLeases::now_ms() const {
  return static_cast<std::uint64_t>(steady_ms() + ahead_ms_);
}

DatabaseFigures FleetLeases::figures() const {
  const std::lock_guard lock(mutex_);
  return figures_;
}

void FleetLeases::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      beat();
    } catch (const std::exception& error) {
      sweeps_ = false;
      spdlog::warn("the leases of this daemon cannot be renewed now: {}", error.what());
    }
    await_beat(stop);
  }
}

// On a thread of its own: a renewal that hangs does not keep it from its time.
void FleetLeases::mind(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    give_up_late();
    await_beat(stop);
  }
}

void FleetLeases::await_beat(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, stop, beat_, [] { return false; });
}

void FleetLeases::beat() {
  const auto since = Clock::now();
  std::map<std::string, Held> held;
  {
    const std::lock_guard lock(mutex_);
    held = held_;
  }
  if (!held.empty()) renew(held, since);
  const Answered hello = database_.ask(
      {say_hello,
       {sql_value(member_.id), sql_value(address_), sql_value(std::string(proto::server_name)),
        sql_value(fleet_schema_version), sql_value(member_.workers), sql_value(static_cast<std::int64_t>(held.size())),
        sql_value(static_cast<std::int64_t>(member_.memory_bytes)), sql_value(proto::write_json(member_.queues))}});
  ahead_ms_ = hello.number(0, 0) - steady_ms();
  take_sweep();
  if (beats_++ % beats_per_measure == 0) measure();
}

void FleetLeases::renew(const std::map<std::string, Held>& held, Clock::time_point since) {
  Json mine = Json::array();
  for (const auto& [job, lease] : held) {
    const std::optional<Progress> progress = hooks_.progress(job);
    mine.push_back({{"id", job},
                    {"attempt", lease.attempt},
                    {"progress", progress ? proto::write_json(progress_json(*progress)) : ""}});
  }
  const Question question{renew_leases,
                          {sql_value(member_.id), sql_value(lease_.count()), sql_value(proto::write_json(mine))}};
  const Answered renewed = database_.ask_again({question}).front();
  std::map<std::string, Held> gone = held;
  const std::lock_guard lock(mutex_);
  for (int row = 0; row < renewed.rows(); ++row) {
    const std::string job = renewed.text(row, 0);
    const auto now = held_.find(job);
    if (now != held_.end() && now->second.attempt == gone.at(job).attempt)
      now->second.safe_until = since + lease_ - margin(lease_);
    gone.erase(job);
  }
  // Those that ended meanwhile are not lost: they are not held any more.
  for (const auto& [job, lease] : gone) {
    const auto now = held_.find(job);
    if (now != held_.end() && now->second.attempt == lease.attempt) now->second.safe_until = Clock::time_point::min();
  }
}

void FleetLeases::give_up_late() {
  std::vector<std::string> late;
  {
    const std::lock_guard lock(mutex_);
    for (auto& [job, held] : held_)
      if (Clock::now() >= held.safe_until && !std::exchange(held.lost, true)) late.push_back(job);
  }
  for (const std::string& job : late) {
    ++lost_;
    spdlog::warn("job={} its lease is lost: the run ends, and another daemon goes on with it", job);
    hooks_.lost(job);
  }
}

// The lock belongs to the connection.
void FleetLeases::take_sweep() {
  if (sweeps_ && sweep_generation_ == database_.generation()) return;
  sweeps_ = database_.ask({"SELECT pg_try_advisory_lock($1)", {sql_value(FleetLock::sweep)}}).flag(0, 0);
  sweep_generation_ = database_.generation();
}

void FleetLeases::measure() {
  const Answered seen = database_.ask({look_at_trouble});
  const DatabaseFigures figures{std::stod(seen.text(0, 0)), static_cast<std::uint64_t>(seen.number(0, 1))};
  if (figures.oldest_transaction_s > long_transaction_s)
    spdlog::warn(
        "a transaction in the database is open for {:.0f} s: while it lasts dead rows stay, and claims slow down; "
        "find it with SELECT * FROM pg_stat_activity ORDER BY xact_start",
        figures.oldest_transaction_s);
  const std::lock_guard lock(mutex_);
  figures_ = figures;
}

}  // namespace sculpt::server
