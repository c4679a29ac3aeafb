#include "server/net/stream.hpp"

#include <openssl/x509.h>

#include <array>

namespace sculpt::server {

std::string Stream::certificate_name() {
  if (!tls_) return {};
  const std::unique_ptr<X509, decltype(&::X509_free)> certificate(::SSL_get1_peer_certificate(tls_->native_handle()),
                                                                  ::X509_free);
  if (!certificate) return {};
  std::array<char, 256> name{};
  const int length = ::X509_NAME_get_text_by_NID(::X509_get_subject_name(certificate.get()), NID_commonName,
                                                 name.data(), static_cast<int>(name.size()));
  return length > 0 ? std::string(name.data(), static_cast<std::size_t>(length)) : std::string();
}

void Stream::end_sending(std::shared_ptr<void> owner) {
  if (tls_) {
    tls_->async_shutdown([owner = std::move(owner)](const boost::system::error_code&) {});
    return;
  }
  boost::system::error_code ignored;
  socket_.shutdown(Socket::shutdown_send, ignored);
}

void Stream::close() {
  boost::system::error_code ignored;
  socket().close(ignored);
}

void teardown(boost::beast::role_type, Stream& stream, boost::system::error_code& error) {
  stream.socket().shutdown(Stream::Socket::shutdown_both, error);
}

void beast_close_socket(Stream& stream) {
  stream.close();
}

}  // namespace sculpt::server
