#include "server/listener.hpp"

#include <spdlog/spdlog.h>

#include "server/net.hpp"
#include "server/services.hpp"
#include "server/session.hpp"

namespace sculpt {
namespace {

using tcp = net::ip::tcp;

constexpr std::chrono::milliseconds accept_pause{100};

}  // namespace

Listener::Listener(Services& services) : services_(services), acceptor_(services.io), pause_(services.io) {
  const Config& config = services.config;
  const std::string address = config.host + ":" + std::to_string(config.port);
  try {
    tcp::resolver resolver(services.io);
    const tcp::endpoint endpoint = *resolver.resolve(config.host, std::to_string(config.port)).begin();
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(tcp::acceptor::reuse_address(true));
    acceptor_.bind(endpoint);
    acceptor_.listen();
  } catch (const boost::system::system_error& error) {
    throw ListenError("cannot listen on " + address + ": " + error.code().message() +
                      "; stop what uses it or choose another address with --listen (port 0: any free one)");
  }
}

void Listener::close() {
  boost::system::error_code ignored;
  acceptor_.close(ignored);
  pause_.cancel();
}

void Listener::for_each(const std::function<void(Session&)>& visit) {
  for (auto entry = sessions_.begin(); entry != sessions_.end();) {
    const std::shared_ptr<Session> session = entry->lock();
    if (session) visit(*session);
    entry = session ? std::next(entry) : sessions_.erase(entry);
  }
}

void Listener::accept() {
  acceptor_.async_accept(
      [this](const boost::system::error_code& error, tcp::socket socket) { on_accept(error, std::move(socket)); });
}

void Listener::on_accept(const boost::system::error_code& error, tcp::socket socket) {
  if (!acceptor_.is_open()) return;
  if (error) {
    // Most likely out of file descriptors: trying again at once would spin.
    spdlog::warn("cannot accept a connection: {}", error.message());
    pause_.expires_after(accept_pause);
    pause_.async_wait([this](const boost::system::error_code& cancelled) {
      if (!cancelled) accept();
    });
    return;
  }
  const auto session = std::make_shared<Session>(std::move(socket), ++accepted_, services_);
  ++services_.counters.connections_opened;
  sessions_.push_back(session);
  session->start();
  accept();
}

}  // namespace sculpt
