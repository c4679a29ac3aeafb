#include "server/net/stream_transport.hpp"

namespace sculpt::server {

void StreamTransport::read(std::size_t limit, ReadHandler handler) {
  buffer_.resize(limit);
  stream_.async_read_some(net::buffer(buffer_), [this, handler = std::move(handler)](
                                                    const boost::system::error_code& error, std::size_t bytes) {
    handler(error, {buffer_.data(), bytes});
  });
}

void StreamTransport::write(std::string_view rest, Frame, WriteHandler handler) {
  stream_.async_write_some(net::buffer(rest.data(), rest.size()), std::move(handler));
}

}  // namespace sculpt::server
