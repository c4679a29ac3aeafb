#include "server/handlers.hpp"
#include "server/services.hpp"
#include "server/session.hpp"
#include "server/version.hpp"

namespace sculpt {

void on_hello(Services& services, Call call) {
  const HelloParams hello = read_hello(call.params);
  if (hello.major != protocol_major) {
    // The session is closed behind the reply.
    const std::shared_ptr<Session> session = call.session;
    session->refuse(call.id, error_object("protocol_unsupported",
                                          "this server speaks protocol [1,0], not [" + std::to_string(hello.major) +
                                              "," + std::to_string(hello.minor) + "]",
                                          "/params/protocol"));
    return session->finish();
  }
  call.session->greet(hello);
  answer(call, {{"protocol", {protocol_major, protocol_minor}},
                {"server", server_name},
                {"epoch", services.store.epoch()},
                {"features", {"chunk", "events", "verify"}},
                {"limits",
                 {{"line", max_line_bytes},
                  {"chunk", max_chunk_bytes},
                  {"blob", services.config.blob_limit_bytes},
                  {"depth", max_json_depth}}}});
}

void on_ping(Services&, Call call) {
  read_nothing(call.params);
  answer(call, Json::object());
}

void on_server_info(Services& services, Call call) {
  read_nothing(call.params);
  const auto uptime = std::chrono::steady_clock::now() - services.started;
  Json jobs = Json::object();
  const auto counts = services.store.counts();
  for (const JobState state : job_states) jobs[name(state)] = counts.at(state);
  answer(call, {{"server", server_name},
                {"protocol", {protocol_major, protocol_minor}},
                {"epoch", services.store.epoch()},
                {"uptime_s", std::chrono::duration_cast<std::chrono::seconds>(uptime).count()},
                {"workers", services.workers},
                {"cells", services.planner.cells()},
                {"queue_paused", services.store.queue_paused()},
                {"jobs", std::move(jobs)}});
}

}  // namespace sculpt
