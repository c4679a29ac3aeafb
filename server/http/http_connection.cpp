#include "server/http/http_connection.hpp"

#include <spdlog/spdlog.h>

#include "server/base/current_error.hpp"
#include "server/net/session.hpp"
#include "server/net/web_socket.hpp"

// Behind net.hpp.
#include <boost/asio/write.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

namespace sculpt::server {
namespace {

namespace http = boost::beast::http;

constexpr std::uint32_t head_bytes = 16 << 10;
constexpr std::chrono::seconds linger_time{5};

std::string text_of(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

HttpRequest read_head(const http::request<http::empty_body>& head) {
  const auto field = [&](http::field name) { return text_of(head[name]); };
  return {text_of(head.method_string()),      text_of(head.target()),
          field(http::field::host),           field(http::field::origin),
          field(http::field::authorization),  field(http::field::range),
          field(http::field::if_range),       field(http::field::if_none_match),
          field(http::field::accept_encoding)};
}

// Content-Length of the reply.
std::uint64_t length_of(const HttpReply& reply) {
  return reply.part ? reply.part->bytes : reply.body.size();
}

}  // namespace

HttpConnection::HttpConnection(Stream stream, Peer peer, ConnectionContext& context, const HttpSources& sources)
    : stream_(std::move(stream)), peer_(std::move(peer)), context_(context), sources_(sources), buffer_(head_bytes) {}

void HttpConnection::start(std::string_view first) {
  buffer_.commit(net::buffer_copy(buffer_.prepare(first.size()), net::buffer(first.data(), first.size())));
  read_request();
}

void HttpConnection::enter(Phase phase) {
  phase_ = phase;
  last_step_ = Clock::now();
}

// --- in

void HttpConnection::read_request() {
  enter(Phase::reading);
  parser_.emplace();
  parser_->header_limit(head_bytes);
  http::async_read_header(
      stream_, buffer_, *parser_,
      [self = shared_from_this()](const boost::system::error_code& error, std::size_t) { self->on_request(error); });
}

void HttpConnection::on_request(const boost::system::error_code& error) {
  if (phase_ == Phase::done) return;
  const bool bad_request = error.category() == http::make_error_code(http::error::bad_method).category() &&
                           error != http::error::end_of_stream && error != http::error::partial_message;
  if (error && !bad_request) return close("the peer is gone");
  plain_ = !error && parser_->get().method() == http::verb::head;
  keep_ = !error && parser_->is_done() && parser_->get().keep_alive() && !peer_.spare;
  enter(Phase::working);
  if (error)
    return reply(error_reply(proto::error_object("bad_request", "this is no HTTP request: " + error.message())));
  try {
    const HttpRequest request = read_head(parser_->get());
    spdlog::debug("conn={} {} {}", peer_.number, request.method, request.target);
    check_page(context_.config, peer_, request);
    check_room(peer_, request);
    if (boost::beast::websocket::is_upgrade(parser_->get()) && request.target == web_socket_path) return upgrade();
    serve(find_route(sources_, context_, peer_, request));
  } catch (...) {
    reply(error_reply(current_error()));
  }
}

void HttpConnection::serve(Route route) {
  if (route.choose) {
    return do_on(
        sources_.reads, [choose = std::move(route.choose)](const std::stop_token&) { return choose(); },
        [work = std::move(route.work)](HttpConnection& self, TaskQueue* queue) {
          self.serve({queue, work});
        });
  }
  if (route.queue == nullptr) return reply(route.work({}));
  do_on(*route.queue, std::move(route.work),
        [](HttpConnection& self, HttpReply result) { self.reply(std::move(result)); });
}

void HttpConnection::upgrade() {
  phase_ = Phase::done;
  auto socket = std::make_unique<WebSocket>(std::move(stream_));
  WebSocket& accepting = *socket;
  auto session = std::make_shared<Session>(std::move(socket), std::move(peer_), context_);
  context_.connections.add(session);
  accepting.accept(parser_->release(), [session](const boost::system::error_code& error) {
    if (error) return session->close("WebSocket handshake failed");
    session->start({});
  });
}

template <class Work, class Next>
void HttpConnection::do_on(TaskQueue& queue, Work work, Next next) {
  queue.add([self = shared_from_this(), work = std::move(work), next](const std::stop_token& stop) mutable {
    using Result = decltype(work(stop));
    std::optional<Result> result;
    Json error;
    try {
      result = work(stop);
    } catch (...) {
      error = current_error();
    }
    // Moved, so that the last owner of a connection is always the I/O thread.
    net::io_context& io = self->context_.io;
    net::post(io, [self = std::move(self), result = std::move(result), error = std::move(error), next]() mutable {
      if (self->phase_ == Phase::done) return;
      if (result) return next(*self, std::move(*result));
      if (self->phase_ == Phase::writing) return self->close("an artifact could not be read");
      self->reply(error_reply(error));
    });
  });
}

// --- out

void HttpConnection::reply(HttpReply reply) {
  enter(Phase::writing);
  auto head = std::make_shared<http::response<http::string_body>>(http::int_to_status(reply.status), 11);
  head->set(http::field::server, "sculptd");
  head->set(http::field::cache_control, "no-cache");
  head->set("X-Content-Type-Options", "nosniff");
  for (const auto& [name, value] : reply.headers) head->set(name, value);
  if (reply.status != 304) {
    head->set(http::field::content_type, reply.type);
    head->content_length(length_of(reply));
  }
  head->keep_alive(keep_);
  if (!plain_) head->body() = reply.body;
  auto serializer = std::make_shared<http::response_serializer<http::string_body>>(*head);
  const std::optional<FilePart> part = plain_ ? std::nullopt : reply.part;
  const auto done = [self = shared_from_this(), head, serializer, part](const boost::system::error_code& error,
                                                                        std::size_t) {
    if (self->phase_ == Phase::done) return;
    if (error && error != http::error::need_more) return self->close("write failed");
    if (part) return self->send_piece(*part);
    self->end_reply();
  };
  if (plain_ || part) {
    http::async_write_header(stream_, *serializer, done);
  } else {
    http::async_write(stream_, *serializer, done);
  }
}

void HttpConnection::send_piece(FilePart rest) {
  enter(Phase::writing);
  if (rest.bytes == 0) return end_reply();
  rest.at.bytes = static_cast<std::size_t>(std::min<std::uint64_t>(rest.at.bytes, rest.bytes));
  do_on(
      sources_.disk,
      [&artifacts = sources_.artifacts, at = rest.at, so_far = rest.so_far](const std::stop_token&) {
        return artifacts.read(at, *so_far).bytes;
      },
      [rest](HttpConnection& self, std::string piece) { self.write_piece(std::move(piece), rest); });
}

void HttpConnection::write_piece(std::string piece, FilePart rest) {
  if (piece.empty()) return close("an artifact became shorter");
  enter(Phase::writing);
  rest.at.offset += piece.size();
  rest.bytes -= piece.size();
  const auto shared = std::make_shared<const std::string>(std::move(piece));
  const auto progress = [self = shared_from_this()](const boost::system::error_code& error, std::size_t) {
    self->last_step_ = Clock::now();
    return error ? 0 : std::size_t{64} << 10;
  };
  net::async_write(stream_, net::buffer(*shared), progress,
                   [self = shared_from_this(), shared, rest](const boost::system::error_code& error, std::size_t) {
                     if (self->phase_ == Phase::done) return;
                     if (error) return self->close("write failed");
                     self->send_piece(rest);
                   });
}

// --- end

void HttpConnection::end_reply() {
  if (keep_) return read_request();
  enter(Phase::lingering);
  stream_.end_sending(shared_from_this());
  linger();
}

// What still comes is thrown away, so that the peer gets our reply instead of a reset.
void HttpConnection::linger() {
  buffer_.clear();
  stream_.async_read_some(buffer_.prepare(head_bytes),
                          [self = shared_from_this()](const boost::system::error_code& error, std::size_t) {
                            if (self->phase_ == Phase::done) return;
                            if (error) return self->close("finished");
                            self->linger();
                          });
}

void HttpConnection::close(const char* reason) {
  if (phase_ == Phase::done) return;
  phase_ = Phase::done;
  spdlog::debug("conn={} closed: {}", peer_.number, reason);
  stream_.close();
}

void HttpConnection::check_deadlines(Clock::time_point now) {
  const Clock::duration still = now - last_step_;
  if (phase_ == Phase::reading && still > context_.config.hello_time) close("no request came in time");
  if (phase_ == Phase::writing && still > context_.config.stall) close("slow_reader");
  if (phase_ == Phase::lingering && still > linger_time) close("lingered too long");
}

}  // namespace sculpt::server
