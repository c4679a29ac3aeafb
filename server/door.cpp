#include "server/door.hpp"

#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include "proto/request.hpp"
#include "server/http/http_connection.hpp"
#include "server/net/session.hpp"
#include "server/net/stream_transport.hpp"

namespace sculpt::server {
namespace {

constexpr char tls_handshake = 0x16;
constexpr std::chrono::seconds spare_time{1};  // for the first bytes of a peer that came when the server was full

// GET, HEAD, POST, PUT, PATCH, DELETE, OPTIONS. No line of the protocol begins so.
bool begins_http(char first) {
  return std::string_view("GHPDO").find(first) != std::string_view::npos;
}

}  // namespace

Door::Door(Stream stream, Peer peer, std::shared_ptr<ssl::context> tls, ConnectionContext& context,
           const HttpSources& http)
    : stream_(std::move(stream)), peer_(std::move(peer)), tls_(std::move(tls)), context_(context), http_(http) {}

void Door::read() {
  stream_.async_read_some(net::buffer(buffer_),
                          [self = shared_from_this()](const boost::system::error_code& error, std::size_t bytes) {
                            if (self->done_) return;
                            if (error) return self->close("left before it said anything");
                            self->on_first_bytes({self->buffer_.data(), bytes});
                          });
}

void Door::on_first_bytes(std::string_view bytes) {
  if (tls_ && !stream_.encrypted() && bytes.front() == tls_handshake) return start_tls(bytes);
  hand_over(bytes);
}

void Door::start_tls(std::string_view first) {
  stream_.start_tls(*tls_, first, [self = shared_from_this()](const boost::system::error_code& error, std::size_t) {
    if (self->done_) return;
    if (error) {
      spdlog::info("conn={} TLS handshake failed: {}", self->peer_.number, error.message());
      return self->close("TLS handshake failed");
    }
    if (const std::string name = self->stream_.certificate_name(); !name.empty()) {
      self->peer_.identity = {name, Scope::submit};
    }
    self->read();
  });
}

void Door::hand_over(std::string_view first) {
  done_ = true;
  const bool exposed = tls_ && !stream_.encrypted() && !peer_.near;
  if (!exposed && begins_http(first.front())) {
    const auto http = std::make_shared<HttpConnection>(std::move(stream_), std::move(peer_), context_, http_);
    context_.connections.add(http);
    return http->start(first);
  }
  const auto session =
      std::make_shared<Session>(std::make_unique<StreamTransport>(std::move(stream_)), std::move(peer_), context_);
  context_.connections.add(session);
  if (exposed) {
    return session->turn_away(
        "tls_required",
        "from another machine this server speaks TLS only: connect with TLS (sculpt --server tls:HOST:PORT); the "
        "connection is closed");
  }
  if (session->spare()) return session->turn_away("too_many_connections", full_sentence);
  session->start(first);
}

void Door::close(const char* reason) {
  if (done_) return;
  done_ = true;
  spdlog::debug("conn={} closed: {}", peer_.number, reason);
  if (peer_.spare && !stream_.encrypted()) {
    const std::string line =
        proto::error_line(nullptr, proto::error_object("too_many_connections", full_sentence)) + "\n";
    ::send(stream_.socket().native_handle(), line.data(), line.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  }
  stream_.close();
}

void Door::check_deadlines(Clock::time_point now) {
  const std::chrono::milliseconds patience = context_.config.hello_time;
  if (now - opened_ > (peer_.spare ? std::min<std::chrono::milliseconds>(patience, spare_time) : patience)) {
    close("nothing came in time");
  }
}

}  // namespace sculpt::server
