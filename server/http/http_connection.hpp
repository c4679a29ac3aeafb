// A connection that speaks HTTP/1.1: requests one after another, or the upgrade to WebSocket. I/O thread only.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "server/http/http_routes.hpp"
#include "server/net/stream.hpp"

// Behind net.hpp.
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>

namespace sculpt::server {

class WebSocket;

class HttpConnection : public Connection, public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(Stream stream, Peer peer, ConnectionContext& context, const HttpSources& sources);
  /// `first`: what was read already.
  void start(std::string_view first);
  void close(const char* reason) override;
  void check_deadlines(Clock::time_point now) override;
  bool spare() const override { return peer_.spare && phase_ != Phase::done; }

 private:
  using Parser = boost::beast::http::request_parser<boost::beast::http::empty_body>;
  enum class Phase { reading, working, writing, lingering, done };

  void enter(Phase phase);
  void read_request();
  void on_request(const boost::system::error_code& error);
  void serve(Route route);
  void upgrade();
  void reply(HttpReply reply);
  void send_piece(FilePart rest);
  void write_piece(std::string piece, FilePart rest);
  void end_reply();
  void linger();
  /// Runs `work` (any thread may call it) and goes on with what it gives on the I/O thread.
  template <class Work, class Next>
  void do_on(class TaskQueue& queue, Work work, Next next);

  Stream stream_;
  Peer peer_;
  ConnectionContext& context_;
  const HttpSources& sources_;
  boost::beast::flat_buffer buffer_;
  std::optional<Parser> parser_;
  Phase phase_ = Phase::reading;
  Clock::time_point last_step_ = Clock::now();
  bool keep_ = false;   // the connection, behind this reply
  bool plain_ = false;  // HEAD: no body
};

}  // namespace sculpt::server
