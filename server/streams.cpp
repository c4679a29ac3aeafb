#include "server/streams.hpp"

#include "server/job_view.hpp"
#include "server/scheduler.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

constexpr int events_at_once = 64;
constexpr std::chrono::milliseconds longest_silence{900};  // ticks come every 250 ms: at least one event a second

bool same(const Progress& a, const Progress& b) {
  return a.stage == b.stage && a.done == b.done && a.total == b.total;
}

}  // namespace

void Streams::subscribe(const std::shared_ptr<Session>& session, const std::string& job, std::uint64_t after) {
  Subscription& subscription = jobs_[job][session.get()];
  subscription = {session, after, false, false, std::nullopt, {}};
  session->subscriptions().insert(job);
  advance(job, subscription);
  forget_ended(job);
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
  const auto found = jobs_.find(job);
  if (found == jobs_.end()) return;
  for (auto& [session, subscription] : found->second) advance(job, subscription);
  forget_ended(job);
}

void Streams::on_writable(Session& session) {
  const std::set<std::string> subscribed = session.subscriptions();
  for (const std::string& job : subscribed) {
    advance(job, jobs_.at(job).at(&session));
    forget_ended(job);
  }
}

void Streams::tick(Clock::time_point now) {
  for (auto& [job, subscribers] : jobs_) {
    const std::optional<Progress> progress = scheduler_.progress(job);
    if (!progress) continue;
    for (auto& [session, subscription] : subscribers) tell(job, subscription, *progress, now);
  }
}

void Streams::advance(const std::string& job, Subscription& subscription) {
  const std::shared_ptr<Session> session = subscription.session.lock();
  if (!session) {
    subscription.ended = true;
    return;
  }
  send_durable(*session, job, subscription);
}

void Streams::send_durable(Session& session, const std::string& job, Subscription& subscription) {
  while (session.writable()) {
    const std::vector<StateEvent> events = store_.events(job, subscription.after, events_at_once);
    for (const StateEvent& event : events) {
      session.send_event({job, event.seq, event.time, "state", parse_json(event.data)});
      subscription.after = event.seq;
      subscription.ended = is_final(event.to);  // unless more comes: a quarantined job may have been retried
    }
    if (events.size() == events_at_once) continue;
    if (!subscription.live) session.send_event({job, std::nullopt, {}, "live", nullptr});
    subscription.live = true;
    return;
  }
  // It lags: what it still has to get comes when it took some bytes, so it may not be forgotten yet.
  subscription.ended = false;
}

void Streams::tell(const std::string& job, Subscription& subscription, const Progress& progress,
                   Clock::time_point now) {
  const std::shared_ptr<Session> session = subscription.session.lock();
  if (!session || !session->writable() || !subscription.live) return;
  const bool silent = now - subscription.told_at >= longest_silence;
  if (subscription.told && same(*subscription.told, progress) && !silent) return;
  session->send_event({job, std::nullopt, {}, "progress", progress_view(progress)});
  subscription.told = progress;
  subscription.told_at = now;
}

void Streams::forget_ended(const std::string& job) {
  const auto found = jobs_.find(job);
  if (found == jobs_.end()) return;
  for (auto entry = found->second.begin(); entry != found->second.end();) {
    if (!entry->second.ended) {
      ++entry;
      continue;
    }
    if (const auto session = entry->second.session.lock()) session->subscriptions().erase(job);
    entry = found->second.erase(entry);
  }
  if (found->second.empty()) jobs_.erase(found);
}

}  // namespace sculpt
