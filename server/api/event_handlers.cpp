// Who wants to hear of what happens.
#include "server/api/handlers.hpp"

namespace sculpt::server {
namespace {

constexpr std::size_t max_subscriptions = 1000;

// Of one job, or of all where no job is named.
std::uint64_t last_event(JobStore& store, const proto::SubscribeParams& wanted) {
  if (!wanted.job.empty()) find_job(store, wanted.job);
  const std::uint64_t last = store.last_event(wanted.job);
  if (wanted.after > last) {
    throw proto::ProtocolError("replay_gap",
                               "after is " + std::to_string(wanted.after) + ", but the last event is " +
                                   std::to_string(last) + ": the store was replaced, start again from 0",
                               "/params/after");
  }
  return last;
}

Json named(const std::string& job) {
  Json result = Json::object();
  if (!job.empty()) result["job"] = job;
  return result;
}

void on_subscribe(const EventGroup& group, Call call) {
  const proto::SubscribeParams wanted = proto::read_subscribe(call.params);
  if (call.session->subscriptions().size() >= max_subscriptions) {
    throw proto::ProtocolError("bad_request",
                               "one connection may follow at most " + std::to_string(max_subscriptions) + " jobs");
  }
  group.answers.read_then(
      std::move(call), [&store = group.store, wanted] { return last_event(store, wanted); },
      [group, wanted](const Call& known, std::uint64_t last) {
        Json result = named(wanted.job);
        result["last"] = last;
        answer(known, result);
        group.streams.subscribe(known.session, wanted.job, wanted.after);
      });
}

void on_unsubscribe(const EventGroup& group, Call call) {
  const std::string job = proto::read_unsubscribe(call.params);
  group.answers.read_then(
      std::move(call),
      [&store = group.store, job] {
        return last_event(store, {job, 0});
      },
      [group, job](const Call& known, std::uint64_t) {
        group.streams.unsubscribe(*known.session, job);
        answer(known, named(job));
      });
}

}  // namespace

Handlers event_handlers(const EventGroup& group) {
  return {
      {"events.subscribe", [group](Call call) { on_subscribe(group, std::move(call)); }},
      {"events.unsubscribe", [group](Call call) { on_unsubscribe(group, std::move(call)); }},
  };
}

}  // namespace sculpt::server
