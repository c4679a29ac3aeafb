// Accepts connections at one address. I/O thread only.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "server/http/http_routes.hpp"
#include "server/net/connection_context.hpp"

namespace boost::asio::ssl {
class context;
}

namespace sculpt::server {

/// The address cannot be listened on; what() says which, why and the cure.
class ListenError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using Endpoint = net::generic::stream_protocol::endpoint;

/// The configured host and port. Throws ListenError; ConfigError where strangers could come in unasked.
Endpoint tcp_endpoint(const Config& config);
/// The configured unix socket; one that a dead daemon left behind is removed. Throws ListenError.
Endpoint unix_endpoint(const Config& config);

class Listener {
 public:
  /// Binds at once. Without `tls` none is spoken. Throws ListenError.
  Listener(ConnectionContext& context, const HttpSources& http, const Endpoint& endpoint,
           std::shared_ptr<net::ssl::context> tls);
  ~Listener() { close(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  void start() { accept(); }
  void close();
  /// Of a TCP address.
  std::uint16_t port() const;

 private:
  using Protocol = net::generic::stream_protocol;

  void accept();
  void on_accept(const boost::system::error_code& error, Protocol::socket socket);
  void wait_for_files(const boost::system::error_code& error);
  Peer peer_of(Protocol::socket& socket) const;

  ConnectionContext& context_;
  const HttpSources& http_;
  Endpoint endpoint_;
  std::shared_ptr<net::ssl::context> tls_;
  net::basic_socket_acceptor<Protocol> acceptor_;
  net::steady_timer pause_;
  bool short_of_files_ = false;
};

}  // namespace sculpt::server
