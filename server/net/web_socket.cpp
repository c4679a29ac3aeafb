#include "server/net/web_socket.hpp"

#include <algorithm>

#include "proto/framing.hpp"

namespace sculpt::server {
namespace {

namespace websocket = boost::beast::websocket;

// A peer that takes bytes slowly is seen to take some between two pieces.
constexpr std::size_t frame_piece_bytes = 64 << 10;

}  // namespace

WebSocket::WebSocket(Stream stream) : socket_(std::move(stream)) {
  socket_.read_message_max(proto::max_chunk_bytes);
}

void WebSocket::accept(Request request, std::function<void(const boost::system::error_code&)> done) {
  request_ = std::move(request);
  socket_.async_accept(request_, std::move(done));
}

void WebSocket::read(std::size_t limit, ReadHandler handler) {
  buffer_.resize(limit + 1);  // the LF that ends a message
  socket_.async_read_some(
      net::buffer(buffer_.data(), limit),
      [this, handler = std::move(handler)](const boost::system::error_code& error, std::size_t bytes) {
        if (!error && socket_.is_message_done()) buffer_[bytes++] = '\n';
        handler(error, {buffer_.data(), bytes});
      });
}

void WebSocket::write(std::string_view rest, Frame kind, WriteHandler handler) {
  const bool last = rest.size() - 1 <= frame_piece_bytes;
  const std::size_t bytes = std::min(rest.size() - 1, frame_piece_bytes);
  socket_.text(kind == Frame::line);
  socket_.async_write_some(
      last, net::buffer(rest.data(), bytes),
      [handler = std::move(handler), last](const boost::system::error_code& error, std::size_t written) {
        handler(error, last ? written + 1 : written);
      });
}

void WebSocket::end_sending(std::shared_ptr<void> owner) {
  socket_.async_close(websocket::close_code::normal, [owner = std::move(owner)](const boost::system::error_code&) {});
}

}  // namespace sculpt::server
