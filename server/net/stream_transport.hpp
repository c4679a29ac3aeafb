// Frames as they are: newline-delimited over a plain or TLS stream.
#pragma once

#include <string>

#include "server/net/stream.hpp"
#include "server/net/transport.hpp"

namespace sculpt::server {

class StreamTransport : public Transport {
 public:
  explicit StreamTransport(Stream stream) : stream_(std::move(stream)) {}

  void read(std::size_t limit, ReadHandler handler) override;
  void write(std::string_view rest, Frame kind, WriteHandler handler) override;
  void end_sending(std::shared_ptr<void> owner) override { stream_.end_sending(std::move(owner)); }
  void close() override { stream_.close(); }
  int native_handle() override { return stream_.socket().native_handle(); }

 private:
  Stream stream_;
  std::string buffer_;
};

}  // namespace sculpt::server
