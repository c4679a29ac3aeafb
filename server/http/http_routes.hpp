// HTTP requests -> what to do for them.
#pragma once

#include <functional>

#include "server/access/access.hpp"
#include "server/access/tickets.hpp"
#include "server/base/task_queue.hpp"
#include "server/files/blobs.hpp"
#include "server/http/http_reply.hpp"
#include "server/http/metrics.hpp"
#include "server/net/connection_context.hpp"
#include "server/results/artifacts.hpp"

namespace sculpt::server {

inline constexpr const char* web_socket_path = "/v1/ws";

/// What requests are answered from. All of it outlives the connections.
struct HttpSources {
  Access& access;
  const Tickets& tickets;
  JobStore& store;
  const Blobs& blobs;
  Artifacts& artifacts;
  MetricSources metrics;
  TaskQueue& reads;     ///< questions to the store
  TaskQueue& disk;      ///< pieces of files
  TaskQueue& exports;   ///< other forms than an artifact's own
  TaskQueue& programs;  ///< robot programs
};

/// Work that gives the reply, and may throw as a handler does.
struct Route {
  TaskQueue* queue = nullptr;  ///< where the work is done; null: at once, on the I/O thread
  std::function<HttpReply(const std::stop_token&)> work;
  std::function<TaskQueue*()> choose = {};  ///< where there is one: asked on the thread of reads for the queue
};

/// Refuses what a stranger's web page would send, and logs it. Throws ProtocolError `host_refused`, `origin_refused`.
void check_page(const Config& config, const Peer& peer, const HttpRequest& request);

/// A full server tells its health and nothing else. Throws ProtocolError `too_many_connections`.
void check_room(const Peer& peer, const HttpRequest& request);

/// Throws ProtocolError: `not_found`, `gone`, `method_refused`, `auth_required`, `forbidden`, `params_invalid`.
Route find_route(const HttpSources& sources, const ConnectionContext& context, const Peer& peer,
                 const HttpRequest& request);

}  // namespace sculpt::server
