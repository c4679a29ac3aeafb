#include "clients/cpp/connection.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>

namespace sculpt {
namespace {

using Clock = std::chrono::steady_clock;

struct Address {
  std::string host, port;
};

Address split(const std::string& server) {
  const std::size_t colon = server.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == server.size()) {
    throw ServerUnreachable("the server address '" + server + "' must be HOST:PORT, for example 127.0.0.1:7878");
  }
  std::string host = server.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  return {host, server.substr(colon + 1)};
}

int connect_to(const addrinfo& address) {
  const int handle = ::socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC, address.ai_protocol);
  if (handle < 0 || ::connect(handle, address.ai_addr, address.ai_addrlen) == 0) return handle;
  const int error = errno;
  ::close(handle);
  errno = error;
  return -1;
}

}  // namespace

Connection::Connection(const std::string& server) : server_(server) {
  const Address address = split(server);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found); error != 0) {
    throw ServerUnreachable("cannot find the server " + server + ": " + ::gai_strerror(error));
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> list(found, ::freeaddrinfo);
  for (const addrinfo* one = found; one != nullptr && socket_ < 0; one = one->ai_next) socket_ = connect_to(*one);
  if (socket_ < 0) {
    throw ServerUnreachable("cannot reach a server at " + server + ": " + std::strerror(errno) +
                            "; start sculptd, or name another with --server");
  }
  const int on = 1;
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

Connection::~Connection() {
  if (socket_ >= 0) ::close(socket_);
}

void Connection::fail(const std::string& what) const {
  throw ServerUnreachable("the connection to " + server_ + " broke: " + what);
}

void Connection::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) fail(std::strerror(errno));
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

void Connection::end_sending() {
  ::shutdown(socket_, SHUT_WR);
}

std::optional<std::string> Connection::read_line(std::optional<double> timeout_s) {
  std::optional<WireFrame> frame = read_frame(timeout_s);
  if (!frame) return std::nullopt;
  if (frame->kind != WireFrame::Kind::line) fail("the server sent a line that is too long");
  return std::move(frame->bytes);
}

std::string Connection::read_chunk(std::size_t bytes) {
  if (bytes > max_chunk_bytes) fail("the server announced a chunk that is too large");
  frames_.expect_chunk(bytes);
  std::optional<WireFrame> frame = read_frame(std::nullopt);
  if (frame->kind != WireFrame::Kind::chunk) fail("the server sent a chunk of another size than announced");
  return std::move(frame->bytes);
}

std::optional<WireFrame> Connection::read_frame(std::optional<double> timeout_s) {
  const auto start = Clock::now();
  std::array<char, 1 << 16> buffer{};
  while (true) {
    if (std::optional<WireFrame> frame = frames_.next()) return frame;
    int wait_ms = -1;
    if (timeout_s) {
      const double left = *timeout_s - std::chrono::duration<double>(Clock::now() - start).count();
      wait_ms = static_cast<int>(std::max(0.0, left) * 1000);
    }
    pollfd ready{socket_, POLLIN, 0};
    const int polled = ::poll(&ready, 1, wait_ms);
    if (polled == 0) return std::nullopt;
    const ssize_t got = polled < 0 ? -1 : ::recv(socket_, buffer.data(), buffer.size(), 0);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(std::strerror(errno));
    if (got == 0) fail("the server closed it");
    frames_.feed({buffer.data(), static_cast<std::size_t>(got)});
  }
}

}  // namespace sculpt
