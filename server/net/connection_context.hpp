// What every connection works with. Owned by Server, which outlives them all.
#pragma once

#include "server/base/config.hpp"
#include "server/base/counters.hpp"
#include "server/net/call.hpp"
#include "server/net/connection.hpp"
#include "server/net/net.hpp"

namespace sculpt::server {

/// I/O thread only, but for `io` and `counters`.
struct ConnectionContext {
  net::io_context& io;
  const Config& config;  ///< a reload changes it
  Connections& connections;
  Counters& counters;
  RequestHandler& requests;
};

}  // namespace sculpt::server
