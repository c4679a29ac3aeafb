// Method names -> handlers, and exceptions -> error replies: the one place on the I/O side where errors are caught.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "server/events/streams.hpp"
#include "server/events/waits.hpp"

namespace sculpt::server {

/// Runs on the I/O thread and must not block. Answers the call, now or later, or throws.
using Handler = std::function<void(Call)>;
/// By the name of the method.
using Handlers = std::map<std::string_view, Handler>;

class Dispatcher : public RequestHandler {
 public:
  /// One handler for each of methods().
  Dispatcher(Handlers handlers, Streams& streams, Waits& waits);

  void take(Call call, const std::string& method) override;
  void on_writable(Session& session) override { streams_.on_writable(session); }
  void on_closed(Session& session) override;

 private:
  Handlers handlers_;
  Streams& streams_;
  Waits& waits_;
};

}  // namespace sculpt::server
