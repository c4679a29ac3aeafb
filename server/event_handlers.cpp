#include "server/detour.hpp"
#include "server/handlers.hpp"

namespace sculpt {
namespace {

constexpr std::size_t max_subscriptions = 1000;

// Of one job, or of all where no job is named.
std::uint64_t last_event(JobStore& store, const SubscribeParams& wanted) {
  if (!wanted.job.empty()) find_job(store, wanted.job);
  const std::uint64_t last = store.last_event(wanted.job);
  if (wanted.after > last) {
    throw ProtocolError("replay_gap",
                        "after is " + std::to_string(wanted.after) + ", but the last event is " + std::to_string(last) +
                            ": the store was replaced, start again from 0",
                        "/params/after");
  }
  return last;
}

Json named(const std::string& job) {
  Json result = Json::object();
  if (!job.empty()) result["job"] = job;
  return result;
}

}  // namespace

void on_subscribe(Services& services, Call call) {
  const SubscribeParams wanted = read_subscribe(call.params);
  if (call.session->subscriptions().size() >= max_subscriptions) {
    throw ProtocolError("bad_request",
                        "one connection may follow at most " + std::to_string(max_subscriptions) + " jobs");
  }
  read_then(
      services, std::move(call), [&store = services.store, wanted] { return last_event(store, wanted); },
      [&services, wanted](const Call& known, std::uint64_t last) {
        Json result = named(wanted.job);
        result["last"] = last;
        answer(known, result);
        services.streams.subscribe(known.session, wanted.job, wanted.after);
      });
}

void on_unsubscribe(Services& services, Call call) {
  const std::string job = read_unsubscribe(call.params);
  read_then(
      services, std::move(call),
      [&store = services.store, job] {
        return last_event(store, {job, 0});
      },
      [&services, job](const Call& known, std::uint64_t) {
        services.streams.unsubscribe(*known.session, job);
        answer(known, named(job));
      });
}

}  // namespace sculpt
