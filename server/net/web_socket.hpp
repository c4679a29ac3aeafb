// A session over WebSocket (RFC 6455): one text message is one line, one binary message one chunk, both without LF.
#pragma once

#include "server/net/stream.hpp"
#include "server/net/transport.hpp"

// Behind net.hpp.
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <string>

namespace sculpt::server {

class WebSocket : public Transport {
 public:
  using Request = boost::beast::http::request<boost::beast::http::empty_body>;

  explicit WebSocket(Stream stream);
  /// Answers the upgrade.
  void accept(Request request, std::function<void(const boost::system::error_code&)> done);

  void read(std::size_t limit, ReadHandler handler) override;
  void write(std::string_view rest, Frame kind, WriteHandler handler) override;
  void end_sending(std::shared_ptr<void> owner) override;
  void close() override { socket_.next_layer().close(); }
  int native_handle() override { return socket_.next_layer().socket().native_handle(); }

 private:
  boost::beast::websocket::stream<Stream> socket_;
  Request request_;
  std::string buffer_;
};

}  // namespace sculpt::server
