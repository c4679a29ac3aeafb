#include "server/fleet/fleet_follower.hpp"

#include <spdlog/spdlog.h>

#include "server/base/progress_text.hpp"

namespace sculpt::server {
namespace {

// A connection that is half gone shows as a look that is not answered; all others of the daemon are then made anew.
constexpr std::chrono::seconds feed_patience{2};
constexpr std::chrono::milliseconds min_look{100}, notice_time{100};
constexpr int look_ms = 1000, jitter_ms = 250;

constexpr const char* progress_of =
    "SELECT id, progress FROM sculptd.job JOIN sculptd.lease ON lease.job = job.number WHERE id = ANY($1::text[]) AND "
    "progress<>''";

}  // namespace

FleetFollower::FleetFollower(const PostgresSource& source, FleetFeed& feed)
    : database_(source, feed_patience), feed_(feed) {}

void FleetFollower::start(Changed changed) {
  changed_ = std::move(changed);
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

void FleetFollower::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

std::optional<Progress> FleetFollower::progress(const std::string& job) const {
  const std::lock_guard lock(mutex_);
  const auto found = progress_.find(job);
  return found == progress_.end() ? std::nullopt : std::optional(found->second);
}

// So that daemons that began together do not ask together for ever.
std::chrono::milliseconds FleetFollower::next_look() {
  return std::chrono::milliseconds(look_ms - jitter_ms + static_cast<int>(random_() % (2 * jitter_ms)));
}

void FleetFollower::work(const std::stop_token& stop) {
  bool reachable = true;
  while (!stop.stop_requested()) {
    try {
      listen();
      look();
      if (!std::exchange(reachable, true)) spdlog::info("the database answers again");
      // Many changes at once are one look, and the first of them is seen at once.
      std::this_thread::sleep_for(min_look);
      const auto end = std::chrono::steady_clock::now() + next_look();
      while (!stop.stop_requested() && std::chrono::steady_clock::now() < end && !database_.await_notice(notice_time)) {
      }
    } catch (const std::exception& error) {
      if (std::exchange(reachable, false)) spdlog::error("other daemons cannot be followed now: {}", error.what());
      std::this_thread::sleep_for(notice_time);
    }
  }
}

void FleetFollower::listen() {
  if (listening_ != 0 && listening_ == database_.generation()) return;
  database_.ask({"LISTEN sculptd"});
  listening_ = database_.generation();
}

void FleetFollower::look() {
  feed_.read(database_);
  const Answered running = database_.ask({progress_of, {feed_.at_work()}});
  std::map<std::string, Progress> progress;
  for (int row = 0; row < running.rows(); ++row)
    if (const std::optional<Progress> now = read_progress_text(running.text(row, 1)))
      progress[running.text(row, 0)] = *now;
  {
    const std::lock_guard lock(mutex_);
    progress_ = std::move(progress);
  }
  for (const FleetNews& news : feed_.take_news()) changed_(news.job, news.to);
}

}  // namespace sculpt::server
