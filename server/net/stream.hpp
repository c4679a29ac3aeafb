// The bytes of one connection: a TCP or unix socket, plain or under TLS, as one type for Asio and Beast.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "server/net/net.hpp"

// Behind net.hpp.
#include <boost/asio/ssl.hpp>
#include <boost/beast/core/role.hpp>

namespace sculpt::server {

namespace ssl = net::ssl;

/// I/O thread only. Must not be moved while it reads or writes.
class Stream {
 public:
  using Socket = net::generic::stream_protocol::socket;
  using executor_type = Socket::executor_type;

  explicit Stream(Socket socket) : socket_(std::move(socket)) {}

  Socket& socket() { return tls_ ? tls_->next_layer() : socket_; }
  executor_type get_executor() { return socket().get_executor(); }

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    if (tls_) {
      tls_->async_read_some(buffers, std::forward<Handler>(handler));
    } else {
      socket_.async_read_some(buffers, std::forward<Handler>(handler));
    }
  }

  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    if (tls_) {
      tls_->async_write_some(buffers, std::forward<Handler>(handler));
    } else {
      socket_.async_write_some(buffers, std::forward<Handler>(handler));
    }
  }

  bool encrypted() const { return tls_ != nullptr; }
  /// The server's side of the handshake; `first` was read already and must stay until `done`.
  template <class Handler>
  void start_tls(ssl::context& context, std::string_view first, Handler&& done) {
    tls_ = std::make_unique<Tls>(std::move(socket_), context);
    tls_->async_handshake(Tls::server, net::buffer(first.data(), first.size()), std::forward<Handler>(done));
  }
  /// Common name of the peer's certificate (checked in the handshake), or empty.
  std::string certificate_name();

  /// Tells the peer that nothing more comes; reading goes on. `owner` is kept until that is done.
  void end_sending(std::shared_ptr<void> owner);
  void close();

 private:
  using Tls = ssl::stream<Socket>;

  Socket socket_;  // moved into tls_ by the handshake
  std::unique_ptr<Tls> tls_;
};

// Beast's WebSocket calls these three when it ends a connection.
void teardown(boost::beast::role_type role, Stream& stream, boost::system::error_code& error);
void beast_close_socket(Stream& stream);
template <class Handler>
void async_teardown(boost::beast::role_type role, Stream& stream, Handler&& handler) {
  boost::system::error_code error;
  teardown(role, stream, error);
  net::post(stream.get_executor(), [handler = std::forward<Handler>(handler), error]() mutable { handler(error); });
}

}  // namespace sculpt::server
