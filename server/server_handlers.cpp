#include <spdlog/spdlog.h>

#include "proto/schema.hpp"
#include "proto/version.hpp"
#include "server/handlers.hpp"
#include "server/services.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

void greet(Services& services, Session& session, const HelloParams& hello) {
  Identity identity = services.access.identify(session.peer(), hello.token);
  const bool known = session.identity() != nullptr && session.owner() == identity.owner;
  const auto most = static_cast<std::size_t>(services.config.max_connections_per_owner);
  if (!known && services.connections.count_of(identity.owner) >= most) {
    throw ProtocolError("too_many_connections", "you have " + std::to_string(most) +
                                                    " connections already: use one for many requests, or raise "
                                                    "max_connections_per_owner");
  }
  session.greet(hello, std::move(identity));
}

// The session is closed behind the reply.
void turn_away(const Call& call, const Json& error) {
  const std::shared_ptr<Session> session = call.session;
  spdlog::info("conn={} {}", session->peer().number, error["data"]["code"].get<std::string>());
  session->refuse(call.id, error);
  session->finish();
}

}  // namespace

void on_hello(Services& services, Call call) {
  const HelloParams hello = read_hello(call.params);
  if (hello.major != protocol_major) {
    return turn_away(call, error_object("protocol_unsupported",
                                        "this server speaks protocol [1,0], not [" + std::to_string(hello.major) + "," +
                                            std::to_string(hello.minor) + "]",
                                        "/params/protocol"));
  }
  try {
    greet(services, *call.session, hello);
  } catch (const ProtocolError& error) {
    return turn_away(call, error_object(error.code(), error.what(), error.pointer()));
  }
  answer(call, {{"protocol", {protocol_major, protocol_minor}},
                {"server", server_name},
                {"epoch", services.store.epoch()},
                {"features", {"chunk", "events", "verify"}},
                {"limits",
                 {{"line", call.session->line_limit()},
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
  answer_read(services, std::move(call), [&services] {
    const auto uptime = std::chrono::steady_clock::now() - services.started;
    Json jobs = Json::object();
    for (const auto& [state, count] : services.store.counts()) jobs[name(state)] = count;
    return Json{{"server", server_name},
                {"protocol", {protocol_major, protocol_minor}},
                {"epoch", services.store.epoch()},
                {"uptime_s", std::chrono::duration_cast<std::chrono::seconds>(uptime).count()},
                {"workers", services.workers},
                {"cells", services.planner.cells()},
                {"queue_paused", services.store.queue_paused()},
                {"jobs", std::move(jobs)}};
  });
}

void on_server_schema(Services& services, Call call) {
  const std::string method = read_schema_method(call.params);
  answer_read(services, std::move(call), [method] { return protocol_schema(method); });
}

}  // namespace sculpt
