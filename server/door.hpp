// A new connection until it is known what it speaks: TLS, HTTP or the protocol itself. I/O thread only.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "server/http/http_routes.hpp"
#include "server/net/connection_context.hpp"
#include "server/net/stream.hpp"

namespace sculpt::server {

class Door : public Connection, public std::enable_shared_from_this<Door> {
 public:
  /// Without `tls` none is spoken.
  Door(Stream stream, Peer peer, std::shared_ptr<ssl::context> tls, ConnectionContext& context,
       const HttpSources& http);
  void start() { read(); }
  /// A spare peer that speaks in the clear is told why.
  void close(const char* reason) override;
  void check_deadlines(Clock::time_point now) override;
  bool spare() const override { return peer_.spare && !done_; }

 private:
  void read();
  void on_first_bytes(std::string_view bytes);
  void start_tls(std::string_view first);
  void hand_over(std::string_view first);

  Stream stream_;
  Peer peer_;
  std::shared_ptr<ssl::context> tls_;
  ConnectionContext& context_;
  const HttpSources& http_;
  std::array<char, 4096> buffer_;
  Clock::time_point opened_ = Clock::now();
  bool done_ = false;  // closed, or handed over
};

}  // namespace sculpt::server
