#include "server/handlers.hpp"
#include "server/job_view.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

constexpr std::size_t max_subscriptions = 1000;

}  // namespace

void on_subscribe(Services& services, Call call) {
  const SubscribeParams wanted = read_subscribe(call.params);
  find_job(services.store, wanted.job);
  const std::uint64_t last = services.store.last_event(wanted.job);
  if (wanted.after > last) {
    throw ProtocolError("replay_gap",
                        "after is " + std::to_string(wanted.after) + ", but the last event of the job is " +
                            std::to_string(last) + ": the store was replaced, start again from 0",
                        "/params/after");
  }
  if (call.session->subscriptions().size() >= max_subscriptions) {
    throw ProtocolError("bad_request",
                        "one connection may follow at most " + std::to_string(max_subscriptions) + " jobs");
  }
  answer(call, {{"job", wanted.job}, {"last", last}});
  services.streams.subscribe(call.session, wanted.job, wanted.after);
}

void on_unsubscribe(Services& services, Call call) {
  const std::string job = read_job_id(call.params);
  find_job(services.store, job);
  services.streams.unsubscribe(*call.session, job);
  answer(call, {{"job", job}});
}

}  // namespace sculpt
