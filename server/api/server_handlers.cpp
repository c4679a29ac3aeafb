// What is asked of the daemon itself.
#include <spdlog/spdlog.h>

#include "proto/schema.hpp"
#include "proto/version.hpp"
#include "server/api/handlers.hpp"

namespace sculpt::server {
namespace {

void greet(const ServerGroup& group, Session& session, const proto::HelloParams& hello) {
  Identity identity = group.access.identify(session.peer(), hello.token);
  const bool known = session.identity() != nullptr && session.owner() == identity.owner;
  const auto most = static_cast<std::size_t>(group.config.max_connections_per_owner);
  if (!known && group.connections.count_of(identity.owner) >= most) {
    throw proto::ProtocolError("too_many_connections", "you have " + std::to_string(most) +
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

void on_hello(const ServerGroup& group, Call call) {
  const proto::HelloParams hello = proto::read_hello(call.params);
  if (hello.major != proto::protocol_major) {
    return turn_away(
        call, proto::error_object("protocol_unsupported",
                                  "this server speaks protocol [1,0], not [" + std::to_string(hello.major) + "," +
                                      std::to_string(hello.minor) + "]",
                                  "/params/protocol"));
  }
  try {
    greet(group, *call.session, hello);
  } catch (const proto::ProtocolError& error) {
    return turn_away(call, proto::error_object(error.code(), error.what(), error.pointer()));
  }
  answer(call, {{"protocol", {proto::protocol_major, proto::protocol_minor}},
                {"server", proto::server_name},
                {"epoch", group.store.epoch()},
                {"owner", call.session->owner()},
                {"scope", name(call.session->identity()->scope)},
                {"features", {"chunk", "events", "verify"}},
                {"limits",
                 {{"line", call.session->line_limit()},
                  {"chunk", proto::max_chunk_bytes},
                  {"blob", group.config.blob_limit_bytes},
                  {"depth", proto::max_json_depth}}}});
}

void on_ping(const ServerGroup&, Call call) {
  proto::read_nothing(call.params);
  answer(call, Json::object());
}

Json fleet_view(FleetStore& fleet) {
  Json daemons = Json::array();
  for (const FleetDaemon& daemon : fleet.daemons())
    daemons.push_back({{"daemon", daemon.id},
                       {"address", daemon.address},
                       {"server", daemon.version},
                       {"workers", daemon.workers},
                       {"running", daemon.running},
                       {"memory_bytes", daemon.memory_bytes},
                       {"queues", daemon.queues},
                       {"silent_s", daemon.silent_s}});
  return daemons;
}

/// A file that is no JSON object is left out: whoever plans with it is told what is wrong.
Json libraries_view(const Planner& planner) {
  Json libraries = Json::object();
  for (const ToolLibraryFile& file : planner.tool_libraries())
    if (Json library = Json::parse(file.json, nullptr, false); library.is_object())
      libraries[file.name] = std::move(library);
  return libraries;
}

void on_server_info(const ServerGroup& group, Call call) {
  proto::read_nothing(call.params);
  group.answers.read(std::move(call), [group] {
    const auto uptime = std::chrono::steady_clock::now() - group.started;
    Json jobs = Json::object();
    for (const auto& [state, count] : group.store.counts()) jobs[name(state)] = count;
    Json info{{"server", proto::server_name},
              {"protocol", {proto::protocol_major, proto::protocol_minor}},
              {"epoch", group.store.epoch()},
              {"uptime_s", std::chrono::duration_cast<std::chrono::seconds>(uptime).count()},
              {"workers", group.workers},
              {"cells", group.planner.cells()},
              {"tool_libraries", libraries_view(group.planner)},
              {"queue_paused", group.store.queue_paused()},
              {"jobs", std::move(jobs)}};
    if (group.fleet != nullptr) info["fleet"] = fleet_view(*group.fleet);
    return info;
  });
}

void on_server_schema(const ServerGroup& group, Call call) {
  const proto::SchemaParams wanted = proto::read_schema(call.params);
  group.answers.read(std::move(call), [wanted] {
    return wanted.part.empty() ? proto::protocol_schema(wanted.method) : proto::protocol_schema_part(wanted.part);
  });
}

}  // namespace

Handlers server_handlers(const ServerGroup& group) {
  return {
      {"hello", [group](Call call) { on_hello(group, std::move(call)); }},
      {"ping", [group](Call call) { on_ping(group, std::move(call)); }},
      {"server.info", [group](Call call) { on_server_info(group, std::move(call)); }},
      {"server.schema", [group](Call call) { on_server_schema(group, std::move(call)); }},
  };
}

}  // namespace sculpt::server
