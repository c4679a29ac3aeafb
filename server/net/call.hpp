// A request on its way to its answer, and who takes requests.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "proto/json.hpp"

namespace sculpt::server {

class Session;

struct Call {
  std::shared_ptr<Session> session;
  Json id;
  Json params;
  std::string chunk;
};

/// The result of a call, with the chunk that follows it if there is one.
struct Answer {
  Json result = Json::object();
  std::optional<std::string> chunk;
};

/// The same as bytes, without the LF of the line.
struct Reply {
  std::string line;
  std::optional<std::string> chunk;
};

/// What sessions hand their requests to, and tell how they fare. I/O thread only; nothing here may block or throw.
class RequestHandler {
 public:
  virtual ~RequestHandler() = default;
  /// Answers the call, now or later: exactly one Session::answer or Session::refuse.
  virtual void take(Call call, const std::string& method) = 0;
  /// The session's peer takes bytes again.
  virtual void on_writable(Session& session) = 0;
  /// The session is gone: nobody hears its answers any more.
  virtual void on_closed(Session& session) = 0;
};

}  // namespace sculpt::server
