// Accepts connections and knows which are open. I/O thread only.
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <stdexcept>
#include <string>

#include "server/net.hpp"
namespace sculpt {

class Session;
struct Services;

/// The address cannot be listened on; what() says which, why and the cure.
class ListenError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Listener {
 public:
  /// Binds at once. Throws ListenError.
  explicit Listener(Services& services);
  void start() { accept(); }
  void close();
  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  void for_each(const std::function<void(Session&)>& visit);

 private:
  void accept();
  void on_accept(const boost::system::error_code& error, net::ip::tcp::socket socket);

  Services& services_;
  net::ip::tcp::acceptor acceptor_;
  net::steady_timer pause_;
  std::list<std::weak_ptr<Session>> sessions_;
  std::uint64_t accepted_ = 0;
};

}  // namespace sculpt
