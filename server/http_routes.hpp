// HTTP requests -> what to do for them.
#pragma once

#include <functional>

#include "server/http_reply.hpp"

namespace sculpt {

class TaskQueue;
struct Peer;
struct Services;

inline constexpr const char* web_socket_path = "/v1/ws";

/// Work that gives the reply, and may throw as a handler does.
struct Route {
  TaskQueue* queue = nullptr;  ///< where the work is done; null: at once, on the I/O thread
  std::function<HttpReply()> work;
  std::function<TaskQueue*()> choose = {};  ///< where there is one: asked on the thread of reads for the queue
};

/// Refuses what a stranger's web page would send, and logs it. Throws ProtocolError `host_refused`, `origin_refused`.
void check_page(const Services& services, const Peer& peer, const HttpRequest& request);

/// A full server tells its health and nothing else. Throws ProtocolError `too_many_connections`.
void check_room(const Peer& peer, const HttpRequest& request);

/// Throws ProtocolError: `not_found`, `method_refused`, `auth_required`, `forbidden`, `params_invalid`.
Route find_route(Services& services, const Peer& peer, const HttpRequest& request);

}  // namespace sculpt
