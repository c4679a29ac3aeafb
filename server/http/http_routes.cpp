#include "server/http/http_routes.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <string_view>

#include "proto/schema.hpp"
#include "server/http/artifact_path.hpp"
#include "server/http/byte_range.hpp"
#include "server/http/health.hpp"
#include "server/http/http_guard.hpp"
#include "server/http/job_cell_reply.hpp"
#include "server/http/page.hpp"

namespace sculpt::server {
namespace {

constexpr std::string_view live_path = "/livez", ready_path = "/readyz";
constexpr std::string_view artifacts_path = "/v1/artifacts/", jobs_path = "/v1/jobs/";
constexpr std::string_view schema_path = "/schema.json";
constexpr std::size_t reply_piece_bytes = 1 << 20;
constexpr int first_of_input = 5001, last_of_input = 5089;  // numbers of errors that say what cannot be made of what

HttpReply ready_reply(const std::string& reason) {
  if (reason.empty()) return {200, "text/plain; charset=utf-8", "ready\n"};
  return {503, "text/plain; charset=utf-8", reason + "\n"};
}

void authorize(const HttpSources& sources, const Peer& peer, const HttpRequest& request) {
  constexpr std::string_view scheme = "Bearer ";
  const bool bearer = request.authorization.starts_with(scheme);
  const std::string token = bearer ? request.authorization.substr(scheme.size()) : std::string();
  require_scope(sources.access.identify(peer, token), Scope::read);
}

const char* media_type_of_format(const std::string& format) {
  if (format == "gzip") return "application/gzip";
  if (format == "zip") return "application/zip";
  if (format == "json") return "application/json";
  if (format == "ndjson") return "application/x-ndjson";
  return format == "csv" ? "text/csv; charset=utf-8" : "application/octet-stream";
}

HttpReply artifact_reply(const HttpSources& sources, proto::ArtifactReadParams wanted, const HttpRequest& request) {
  wanted.bytes = 0;
  const auto so_far = std::make_shared<WholeRead>();
  const ArtifactChunk now = sources.artifacts.read(wanted, *so_far);
  if (!now.final) {
    throw proto::ProtocolError("wrong_state",
                               "the " + wanted.artifact + " of job " + wanted.job +
                                   " still grows: HTTP gives what is final; follow it with artifact.read");
  }
  wanted.format = now.format;
  wanted.bytes = reply_piece_bytes;
  const std::string tag = "\"" + now.sha256 + "\"";
  HttpReply reply{200, media_type_of_format(now.format), {}, {}, {{"ETag", tag}, {"Accept-Ranges", "bytes"}}};
  if (is_known(request, tag)) {
    reply.status = 304;
    return reply;
  }
  const bool stale = !request.if_range.empty() && request.if_range != tag;
  const ByteRange range = stale ? ByteRange{} : read_range(request.range, now.size);
  const std::string size = std::to_string(now.size);
  if (range.kind == ByteRange::Kind::unsatisfiable) {
    reply.status = 416;
    reply.headers.emplace_back("Content-Range", "bytes */" + size);
    return reply;
  }
  if (range.kind == ByteRange::Kind::whole && now.size <= reply_piece_bytes) {
    reply.body = sources.artifacts.read(wanted, *so_far).bytes;
    return reply;
  }
  reply.part = {wanted, now.size, so_far};
  if (range.kind == ByteRange::Kind::part) {
    reply.status = 206;
    reply.part->at.offset = range.offset;
    reply.part->bytes = range.bytes;
    reply.headers.emplace_back("Content-Range", "bytes " + std::to_string(range.offset) + "-" +
                                                    std::to_string(range.offset + range.bytes - 1) + "/" + size);
  }
  return reply;
}

Route artifact_route(const HttpSources& sources, const proto::ArtifactReadParams& wanted, const HttpRequest& request) {
  return {nullptr,
          [sources, wanted, request](const std::stop_token& stop) {
            sources.artifacts.make_export(wanted, stop);
            return artifact_reply(sources, wanted, request);
          },
          [sources, wanted] {
            find_job(sources.store, wanted.job);
            if (!sources.artifacts.needs_export(wanted)) return &sources.disk;
            return find_form(wanted).in_child() ? &sources.programs : &sources.exports;
          }};
}

// TICKET/NAME: the name is what a browser calls the file.
Route link_route(const HttpSources& sources, const HttpRequest& request) {
  const std::string rest = request.target.substr(links_path.size());
  const std::string ticket = rest.substr(0, rest.find('/'));
  return artifact_route(sources, sources.tickets.redeem(ticket), request);
}

// JOB/cell/[HASH]
Route cell_route(const HttpSources& sources, const HttpRequest& request) {
  constexpr std::string_view cell = "/cell/";
  const std::string path = request.target.substr(jobs_path.size());
  const std::size_t middle = path.find(cell);
  if (middle == std::string::npos)
    throw proto::ProtocolError("not_found", "of a job there is /v1/jobs/JOB/cell/, and /v1/jobs/JOB/cell/HASH");
  return {&sources.disk, [sources, request, job = path.substr(0, middle),
                          file = path.substr(middle + cell.size())](const std::stop_token&) {
            return job_cell_reply(sources.store, sources.blobs, {job, file}, request);
          }};
}

unsigned status_of(std::string_view code) {
  if (code == "not_found") return 404;
  if (code == "gone") return 410;
  if (code == "params_invalid" || code == "bad_request") return 400;
  if (code == "auth_required") return 401;
  if (code == "forbidden" || code == "origin_refused") return 403;
  if (code == "method_refused") return 405;
  if (code == "wrong_state") return 409;
  if (code == "host_refused") return 421;
  if (const int number = proto::find_error(code).number; number >= first_of_input && number <= last_of_input)
    return 422;
  return code == "stopping" || code == "too_many_connections" ? 503 : 500;
}

[[noreturn]] void refuse_page(const Peer& peer, const HttpRequest& request, const char* code,
                              const std::string& sentence) {
  // As JSON, so that no header can forge a line of the log.
  spdlog::info("conn={} {} host={} origin={}", peer.number, code, proto::write_json(request.host),
               proto::write_json(request.origin));
  throw proto::ProtocolError(code, sentence);
}

}  // namespace

bool is_known(const HttpRequest& request, const std::string& tag) {
  const std::string& known = request.if_none_match;
  return !known.empty() && (known == "*" || known.find(tag) != std::string::npos);
}

HttpReply error_reply(const Json& error) {
  HttpReply reply{status_of(error["data"]["code"].get<std::string>()), "application/json",
                  proto::write_json(error) + "\n"};
  if (reply.status == 401) reply.headers.emplace_back("WWW-Authenticate", "Bearer");
  if (reply.status == 405) reply.headers.emplace_back("Allow", "GET, HEAD");
  return reply;
}

void check_page(const Config& config, const Peer& peer, const HttpRequest& request) {
  if (!peer.browsable) return;
  std::vector<std::string> names = config.host_names;
  names.insert(names.end(), {config.host, peer.address});
  if (!host_allowed(request.host, names)) {
    refuse_page(peer, request, "host_refused",
                "this server is not called '" + request.host + "': use its address, or add the name to host_names");
  }
  if (!origin_allowed(request.origin, request.host, config.origins)) {
    refuse_page(peer, request, "origin_refused", "pages of another origin may not call this server: add it to origins");
  }
}

void check_room(const Peer& peer, const HttpRequest& request) {
  if (peer.spare && request.target != live_path && request.target != ready_path)
    throw proto::ProtocolError("too_many_connections", full_sentence);
}

Route find_route(const HttpSources& sources, const ConnectionContext& context, const Peer& peer,
                 const HttpRequest& request) {
  if (request.method != "GET" && request.method != "HEAD") {
    throw proto::ProtocolError("method_refused", "HTTP only reads here (GET, HEAD): give work over " +
                                                     std::string(web_socket_path) + " or newline-delimited JSON-RPC");
  }
  if (request.target == live_path)
    return {nullptr, [](const std::stop_token&) { return HttpReply{200, "text/plain; charset=utf-8", "alive\n"}; }};
  if (request.target == ready_path) {
    // Copied here: a reload changes the config while the disk is looked at.
    return {&sources.disk, [&store = sources.store, fleet = sources.metrics.fleet, data = context.config.data,
                            floor = context.config.disk_floor_bytes](const std::stop_token&) {
              return ready_reply(why_not_ready(data, floor, store, fleet));
            }};
  }
  if (is_page(request.target))
    return {&sources.disk,
            [folder = context.config.web, request](const std::stop_token&) { return page_reply(folder, request); }};
  if (request.target.starts_with(links_path)) return link_route(sources, request);
  authorize(sources, peer, request);
  if (request.target == "/metrics") {
    return {&sources.reads, [metrics = sources.metrics, open = context.connections.count(),
                             data = context.config.data](const std::stop_token&) {
              return HttpReply{200, "text/plain; version=0.0.4; charset=utf-8", metrics_text(metrics, open, data)};
            }};
  }
  if (request.target == schema_path) {
    return {nullptr, [](const std::stop_token&) {
              return HttpReply{200, "application/schema+json", std::string(proto::schema_text())};
            }};
  }
  if (request.target.starts_with(artifacts_path))
    return artifact_route(sources, read_artifact_path(std::string_view(request.target).substr(artifacts_path.size())),
                          request);
  if (request.target.starts_with(jobs_path)) return cell_route(sources, request);
  throw proto::ProtocolError("not_found",
                             "there is nothing at this path: there are the page at /, /livez, /readyz, /metrics, "
                             "/schema.json, /v1/artifacts/JOB/NAME[?format=FORMAT], /v1/jobs/JOB/cell/, "
                             "/v1/links/TICKET/NAME and the WebSocket " +
                                 std::string(web_socket_path));
}

}  // namespace sculpt::server
