#include "server/events/streams.hpp"

#include <spdlog/spdlog.h>

#include "server/base/task_queue.hpp"
#include "server/events/job_view.hpp"
#include "server/net/session.hpp"
#include "server/queue/scheduler.hpp"

namespace sculpt::server {
namespace {

constexpr int events_at_once = 64;
constexpr std::chrono::milliseconds max_silence{900};  // ticks come every 250 ms: at least one event a second

bool same(const Progress& a, const Progress& b) {
  return a.stage == b.stage && a.done == b.done && a.total == b.total;
}

// Null, which the client sees as left out, where the row is damaged.
Json data_of(const StateEvent& event) {
  try {
    return proto::parse_json(event.data);
  } catch (const proto::JsonError& error) {
    spdlog::error("job={} event {} in the database cannot be read: {}", event.job, event.seq, error.what());
    return nullptr;
  }
}

}  // namespace

void Streams::subscribe(const std::shared_ptr<Session>& session, const std::string& job, std::uint64_t after) {
  if (session->closed()) return;
  Subscription& subscription = jobs_[job][session.get()];
  subscription = {};
  subscription.session = session;
  subscription.serial = ++last_serial_;
  subscription.after = after;
  session->subscriptions().insert(job);
  advance(job, subscription);
}

void Streams::unsubscribe(Session& session, const std::string& job) {
  session.subscriptions().erase(job);
  const auto found = jobs_.find(job);
  if (found == jobs_.end()) return;
  found->second.erase(&session);
  if (found->second.empty()) jobs_.erase(found);
}

void Streams::drop(Session& session) {
  const std::set<std::string> subscribed = session.subscriptions();
  for (const std::string& job : subscribed) unsubscribe(session, job);
}

void Streams::on_changed(const std::string& job) {
  for (const std::string& key : {job, std::string()}) {
    const auto found = jobs_.find(key);
    if (found == jobs_.end()) continue;
    for (auto& [session, subscription] : found->second) {
      subscription.behind = true;
      advance(key, subscription);
    }
  }
}

void Streams::on_writable(Session& session) {
  for (const std::string& job : session.subscriptions()) advance(job, jobs_.at(job).at(&session));
}

void Streams::tick(Clock::time_point now) {
  for (auto& [job, subscribers] : jobs_) {
    const std::optional<Progress> progress = job.empty() ? std::nullopt : scheduler_.progress(job);
    if (!progress) continue;
    for (auto& [session, subscription] : subscribers) tell(job, subscription, *progress, now);
  }
}

Streams::Subscription* Streams::find(const std::string& job, Session* session, std::uint64_t serial) {
  const auto subscribers = jobs_.find(job);
  if (subscribers == jobs_.end()) return nullptr;
  const auto found = subscribers->second.find(session);
  return found != subscribers->second.end() && found->second.serial == serial ? &found->second : nullptr;
}

void Streams::advance(const std::string& job, Subscription& subscription) {
  if (!subscription.behind || subscription.reading || !subscription.session->writable()) return;
  subscription.behind = false;
  subscription.reading = true;
  reads_.add([this, job, session = subscription.session.get(), serial = subscription.serial,
              after = subscription.after](const std::stop_token&) {
    std::optional<std::vector<StateEvent>> events;
    try {
      events = store_.events(job, after, events_at_once);
    } catch (const std::exception& error) {
      spdlog::error("events cannot be read: {}", error.what());
    }
    net::post(io_, [this, job, session, serial, events = std::move(events)] {
      Subscription* asking = find(job, session, serial);
      if (asking == nullptr) return;
      if (!events) return asking->session->close("its events cannot be read");
      take(job, *asking, *events);
    });
  });
}

void Streams::take(const std::string& job, Subscription& subscription, const std::vector<StateEvent>& events) {
  Session& session = *subscription.session;
  subscription.reading = false;
  for (const StateEvent& event : events) {
    proto::EventMessage message{event.job, event.seq, event.time, "state", data_of(event)};
    if (job.empty()) message.number = event.number;
    session.send_event(message);
    subscription.after = job.empty() ? event.number : event.seq;
    subscription.ended = !job.empty() && is_final(event.to);  // unless more comes: a quarantined job may be retried
  }
  if (events.size() == events_at_once) subscription.behind = true;
  if (subscription.behind) return advance(job, subscription);
  if (!std::exchange(subscription.live, true)) session.send_event({job, std::nullopt, {}, "live", nullptr});
  if (!subscription.ended) return;
  const std::shared_ptr<Session> last = subscription.session;
  unsubscribe(*last, job);
  last->close_if_done();
}

void Streams::tell(const std::string& job, Subscription& subscription, const Progress& progress,
                   Clock::time_point now) {
  if (!subscription.session->writable() || !subscription.live) return;
  const bool silent = now - subscription.told_at >= max_silence;
  if (subscription.told && same(*subscription.told, progress) && !silent) return;
  subscription.session->send_event({job, std::nullopt, {}, "progress", progress_view(progress)});
  subscription.told = progress;
  subscription.told_at = now;
}

}  // namespace sculpt::server
