// A TCP, TLS or unix connection that gives frames of the wire (proto/framing.hpp) instead of bytes.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "clients/cpp/tls_link.hpp"
#include "proto/framing.hpp"

namespace sculpt::client {

/// Nobody answers at the address, or the connection broke. The sentence names the address.
class ServerUnreachable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Blocking; not shared between threads. Every method throws ServerUnreachable.
class Connection {
 public:
  /// "HOST:PORT", "[V6]:PORT", "tls:HOST:PORT" or "unix:PATH".
  explicit Connection(const std::string& server, const Login& login = login_from_environment());
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void send(std::string_view bytes);
  /// The next line. With a timeout: nothing when it did not come in time.
  std::optional<std::string> read_line(std::optional<double> timeout_s = {});
  /// The chunk behind the line that was read last.
  std::string read_chunk(std::size_t bytes);
  /// Tells the server that nothing more will be sent.
  void end_sending();

 private:
  std::optional<proto::WireFrame> read_frame(std::optional<double> timeout_s);
  std::size_t receive(char* buffer, std::size_t bytes);
  bool wait_for_bytes(int timeout_ms);
  [[noreturn]] void fail(const std::string& what) const;

  std::string server_;
  int socket_ = -1;
  std::unique_ptr<TlsLink> tls_;  // null: plain
  proto::FrameReader frames_;
};

}  // namespace sculpt::client
