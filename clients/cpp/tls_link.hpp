// TLS over a connected socket, as a client: checks the server's certificate against its host name. Blocking.
#pragma once

#include <memory>
#include <string>

#include "clients/cpp/login.hpp"

namespace sculpt::client {

class TlsLink {
 public:
  /// Does the handshake. Throws std::runtime_error saying why it failed.
  TlsLink(int socket, const std::string& host, const Login& login);
  ~TlsLink();

  /// As ::recv and ::send: bytes, 0 at the end. Throw std::runtime_error.
  std::size_t read(char* buffer, std::size_t bytes);
  std::size_t write(const char* bytes, std::size_t size);
  /// Bytes wait that poll does not see.
  bool pending() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sculpt::client
