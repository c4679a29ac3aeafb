#include "server/listener.hpp"

#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>

#include "server/door.hpp"

namespace sculpt::server {
namespace {

using tcp = net::ip::tcp;

constexpr std::chrono::milliseconds accept_pause{100};
constexpr rlim_t files_for_others = 32;  // database, artifacts, log, spare places: connections may not take these
constexpr std::size_t spare_places = 8;  // for those who ask a full server for its health

std::string shown(const Config& config) {
  return config.host + ":" + std::to_string(config.port);
}

tcp::endpoint to_tcp(const Endpoint& endpoint) {
  tcp::endpoint out;
  std::memcpy(out.data(), endpoint.data(), endpoint.size());
  out.resize(endpoint.size());
  return out;
}

bool is_unix(const Endpoint& endpoint) {
  return endpoint.data()->sa_family == AF_UNIX;
}

std::string path_of(const Endpoint& endpoint) {
  return reinterpret_cast<const sockaddr_un*>(endpoint.data())->sun_path;
}

std::size_t max_connections(const Config& config) {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  const rlim_t room = files.rlim_cur > 2 * files_for_others ? files.rlim_cur - files_for_others : files_for_others;
  return std::min<std::size_t>(static_cast<std::size_t>(config.max_connections), room);
}

std::atomic<std::uint64_t> last_connection = 0;

}  // namespace

Endpoint tcp_endpoint(const Config& config) {
  tcp::endpoint endpoint;
  try {
    net::io_context io;
    tcp::resolver resolver(io);
    endpoint = *resolver.resolve(config.host, std::to_string(config.port)).begin();
  } catch (const boost::system::system_error& error) {
    throw ListenError("cannot listen on " + shown(config) + ": " + error.code().message() +
                      "; choose another address with --listen");
  }
  if (!endpoint.address().is_loopback() && config.tokens.empty() && config.tls_client_ca.empty()) {
    throw ConfigError("refusing to listen on " + shown(config) +
                      ", where everybody who reaches this machine could give it work: set tokens (sculptd token add) "
                      "or tls_client_ca in the config file, or listen on 127.0.0.1");
  }
  return endpoint;
}

Endpoint unix_endpoint(const Config& config) {
  const std::string path = config.unix_socket;
  if (path.size() >= sizeof(sockaddr_un::sun_path)) {
    throw ListenError("the path of the unix socket '" + path + "' is too long: at most " +
                      std::to_string(sizeof(sockaddr_un::sun_path) - 1) + " bytes");
  }
  struct stat found {};
  if (::stat(path.c_str(), &found) == 0 && S_ISSOCK(found.st_mode)) {
    net::io_context io;
    net::local::stream_protocol::socket probe(io);
    boost::system::error_code error;
    probe.connect(net::local::stream_protocol::endpoint(path), error);
    if (!error) throw ListenError("another program listens on the unix socket '" + path + "': stop it or use another");
    ::unlink(path.c_str());
  }
  return net::local::stream_protocol::endpoint(path);
}

Listener::Listener(ConnectionContext& context, const HttpSources& http, const Endpoint& endpoint,
                   std::shared_ptr<net::ssl::context> tls)
    : context_(context),
      http_(http),
      endpoint_(endpoint),
      tls_(std::move(tls)),
      acceptor_(context.io),
      pause_(context.io) {
  try {
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(net::socket_base::reuse_address(true));
    acceptor_.bind(endpoint);
    acceptor_.listen();
  } catch (const boost::system::system_error& error) {
    throw ListenError("cannot listen on " + (is_unix(endpoint) ? path_of(endpoint) : shown(context.config)) + ": " +
                      error.code().message() +
                      "; stop what uses it or choose another address with --listen (port 0: any free one)");
  }
  // Everybody may knock: who they are is asked of the kernel, and strangers need a token.
  if (is_unix(endpoint)) ::chmod(path_of(endpoint).c_str(), 0666);
}

std::uint16_t Listener::port() const {
  return to_tcp(acceptor_.local_endpoint()).port();
}

void Listener::close() {
  if (!acceptor_.is_open()) return;
  boost::system::error_code ignored;
  acceptor_.close(ignored);
  pause_.cancel();
  if (is_unix(endpoint_)) ::unlink(path_of(endpoint_).c_str());
}

void Listener::accept() {
  acceptor_.async_accept(
      [this](const boost::system::error_code& error, Protocol::socket socket) { on_accept(error, std::move(socket)); });
}

void Listener::on_accept(const boost::system::error_code& error, Protocol::socket socket) {
  if (!acceptor_.is_open()) return;
  if (error) return wait_for_files(error);
  short_of_files_ = false;
  Peer peer = peer_of(socket);
  peer.spare = context_.connections.count() >= max_connections(context_.config);
  if (peer.spare) context_.connections.thin_spare(spare_places - 1);
  const auto door = std::make_shared<Door>(Stream(std::move(socket)), std::move(peer), tls_, context_, http_);
  context_.connections.add(door);
  ++context_.counters.connections;
  door->start();
  accept();
}

// Most likely out of file descriptors: trying again at once would spin.
void Listener::wait_for_files(const boost::system::error_code& error) {
  if (!std::exchange(short_of_files_, true)) spdlog::warn("cannot accept connections for now: {}", error.message());
  pause_.expires_after(accept_pause);
  pause_.async_wait([this](const boost::system::error_code& cancelled) {
    if (!cancelled) accept();
  });
}

Peer Listener::peer_of(Protocol::socket& socket) const {
  Peer peer;
  peer.number = ++last_connection;
  boost::system::error_code ignored;
  if (is_unix(endpoint_)) {
    peer.browsable = false;
    ucred other{};
    socklen_t size = sizeof other;
    const bool known = ::getsockopt(socket.native_handle(), SOL_SOCKET, SO_PEERCRED, &other, &size) == 0;
    if (known && (other.uid == ::geteuid() || other.uid == 0)) {
      peer.identity = {"uid:" + std::to_string(other.uid), Scope::admin};
    }
    return peer;
  }
  socket.set_option(tcp::no_delay(true), ignored);
  const tcp::endpoint here = to_tcp(socket.local_endpoint(ignored)), there = to_tcp(socket.remote_endpoint(ignored));
  peer.near = there.address().is_loopback();
  peer.address = here.address().to_string();
  if (http_.access.open()) peer.identity = Identity{"", Scope::admin};
  return peer;
}

}  // namespace sculpt::server
