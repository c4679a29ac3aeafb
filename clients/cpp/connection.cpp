#include "clients/cpp/connection.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>

namespace sculpt::client {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view unix_prefix = "unix:", tls_prefix = "tls:";

struct Address {
  std::string host, port;
};

Address split(const std::string& server) {
  const std::size_t colon = server.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == server.size()) {
    throw ServerUnreachable("the server address '" + server +
                            "' must be HOST:PORT, tls:HOST:PORT or unix:PATH, for example 127.0.0.1:7878");
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

int connect_to_host(const std::string& server, const Address& address) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found); error != 0) {
    throw ServerUnreachable("cannot find the server " + server + ": " + ::gai_strerror(error));
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> list(found, ::freeaddrinfo);
  int handle = -1;
  for (const addrinfo* one = found; one != nullptr && handle < 0; one = one->ai_next) handle = connect_to(*one);
  return handle;
}

int connect_to_path(std::string_view path) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  if (path.size() >= sizeof name.sun_path) throw ServerUnreachable("the path of the unix socket is too long");
  path.copy(name.sun_path, path.size());
  addrinfo address{};
  address.ai_family = AF_UNIX;
  address.ai_socktype = SOCK_STREAM;
  address.ai_addr = reinterpret_cast<sockaddr*>(&name);
  address.ai_addrlen = sizeof name;
  return connect_to(address);
}

}  // namespace

Connection::Connection(const std::string& server, const Login& login) : server_(server) {
  const bool by_path = server.starts_with(unix_prefix), secure = server.starts_with(tls_prefix);
  const Address address = by_path ? Address{} : split(secure ? server.substr(tls_prefix.size()) : server);
  socket_ =
      by_path ? connect_to_path(std::string_view(server).substr(unix_prefix.size())) : connect_to_host(server, address);
  if (socket_ < 0) {
    throw ServerUnreachable("cannot reach a server at " + server + ": " + std::strerror(errno) +
                            "; start sculptd, or name another with --server");
  }
  const int on = 1;
  if (!by_path) ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  if (!secure) return;
  try {
    tls_ = std::make_unique<TlsLink>(socket_, address.host, login);
  } catch (const std::runtime_error& error) {
    ::close(socket_);
    throw ServerUnreachable("cannot reach " + server + ": " + error.what());
  }
}

Connection::~Connection() {
  if (socket_ >= 0) ::close(socket_);
}

void Connection::fail(const std::string& what) const {
  throw ServerUnreachable("the connection to " + server_ + " broke: " + what);
}

void Connection::send(std::string_view bytes) {
  while (!bytes.empty()) {
    if (tls_) {
      try {
        bytes.remove_prefix(tls_->write(bytes.data(), bytes.size()));
        continue;
      } catch (const std::runtime_error& error) {
        fail(error.what());
      }
    }
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) fail(std::strerror(errno));
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

// False: nothing came in time (-1: no limit).
bool Connection::wait_for_bytes(int timeout_ms) {
  if (tls_ && tls_->pending()) return true;
  pollfd ready{socket_, POLLIN, 0};
  const int polled = ::poll(&ready, 1, timeout_ms);
  if (polled < 0 && errno != EINTR) fail(std::strerror(errno));
  return polled != 0;
}

// 0: the server closed the connection.
std::size_t Connection::receive(char* buffer, std::size_t bytes) {
  while (true) {
    if (tls_) {
      try {
        return tls_->read(buffer, bytes);
      } catch (const std::runtime_error& error) {
        fail(error.what());
      }
    }
    const ssize_t got = ::recv(socket_, buffer, bytes, 0);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) fail(std::strerror(errno));
  }
}

void Connection::end_sending() {
  ::shutdown(socket_, SHUT_WR);
}

std::optional<std::string> Connection::read_line(std::optional<double> timeout_s) {
  std::optional<proto::WireFrame> frame = read_frame(timeout_s);
  if (!frame) return std::nullopt;
  if (frame->kind != proto::WireFrame::Kind::line) fail("the server sent a line that is too long");
  return std::move(frame->bytes);
}

std::string Connection::read_chunk(std::size_t bytes) {
  if (bytes > proto::max_chunk_bytes) fail("the server announced a chunk that is too large");
  frames_.expect_chunk(bytes);
  std::optional<proto::WireFrame> frame = read_frame(std::nullopt);
  if (frame->kind != proto::WireFrame::Kind::chunk) fail("the server sent a chunk of another size than announced");
  return std::move(frame->bytes);
}

std::optional<proto::WireFrame> Connection::read_frame(std::optional<double> timeout_s) {
  const auto start = Clock::now();
  std::array<char, 1 << 16> buffer{};
  while (true) {
    if (std::optional<proto::WireFrame> frame = frames_.next()) return frame;
    int wait_ms = -1;
    if (timeout_s) {
      const double left = *timeout_s - std::chrono::duration<double>(Clock::now() - start).count();
      wait_ms = static_cast<int>(std::max(0.0, left) * 1000);
    }
    if (!wait_for_bytes(wait_ms)) return std::nullopt;
    const std::size_t got = receive(buffer.data(), buffer.size());
    if (got == 0) fail("the server closed it");
    frames_.feed({buffer.data(), got});
  }
}

}  // namespace sculpt::client
