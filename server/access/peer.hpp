// Who is at the other end of a connection, and what they may do.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/access/tokens.hpp"

namespace sculpt::server {

struct Identity {
  std::string owner;  ///< name of the token or certificate, "uid:N" of a unix socket's peer; empty: nobody has a name
  Scope scope = Scope::read;
};

/// Who is at the other end, as far as the socket tells.
struct Peer {
  std::uint64_t number = 0;          ///< of the connection, for the log
  bool near = true;                  ///< on this machine: loopback or unix socket
  bool browsable = true;             ///< a browser may be behind it: anything but a unix socket
  std::string address;               ///< of this server, as the peer reached it; empty for a unix socket
  std::optional<Identity> identity;  ///< known without a token
  bool spare = false;                ///< came when the server was full: it may only ask for its health
};

}  // namespace sculpt::server
