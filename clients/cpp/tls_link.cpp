#include "clients/cpp/tls_link.hpp"

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <array>
#include <climits>
#include <csignal>
#include <stdexcept>

namespace sculpt::client {
namespace {

std::string last_error(const SSL* link) {
  if (link != nullptr && ::SSL_get_verify_result(link) != X509_V_OK) {
    return std::string("the server's certificate is not trusted: ") +
           ::X509_verify_cert_error_string(::SSL_get_verify_result(link)) +
           "; SCULPT_TLS_CA names the file of the authority that signed it";
  }
  const unsigned long code = ::ERR_get_error();
  if (code == 0) return "TLS failed: the server closed the connection; it may not speak TLS";
  std::array<char, 256> text{};
  ::ERR_error_string_n(code, text.data(), text.size());
  return std::string("TLS failed: ") + text.data();
}

void require(bool good, const SSL* link = nullptr) {
  if (!good) throw std::runtime_error(last_error(link));
}

// OpenSSL writes to a broken connection without MSG_NOSIGNAL: that must be an error of this call, not the end of the
// program.
class NoBrokenPipe {
 public:
  NoBrokenPipe() {
    ::sigemptyset(&pipe_);
    ::sigaddset(&pipe_, SIGPIPE);
    ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoBrokenPipe() {
    const timespec at_once{};
    if (::sigismember(&before_, SIGPIPE) == 0) ::sigtimedwait(&pipe_, nullptr, &at_once);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoBrokenPipe(const NoBrokenPipe&) = delete;
  NoBrokenPipe& operator=(const NoBrokenPipe&) = delete;

 private:
  sigset_t pipe_{}, before_{};
};

}  // namespace

struct TlsLink::Impl {
  std::unique_ptr<SSL_CTX, decltype(&::SSL_CTX_free)> context{::SSL_CTX_new(::TLS_client_method()), ::SSL_CTX_free};
  std::unique_ptr<SSL, decltype(&::SSL_free)> link{nullptr, ::SSL_free};
};

TlsLink::TlsLink(int socket, const std::string& host, const Login& login) : impl_(std::make_unique<Impl>()) {
  ::ERR_clear_error();
  SSL_CTX* context = impl_->context.get();
  require(context != nullptr);
  ::SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
  ::SSL_CTX_set_verify(context, SSL_VERIFY_PEER, nullptr);
  require(login.ca.empty() ? ::SSL_CTX_set_default_verify_paths(context) == 1
                           : ::SSL_CTX_load_verify_file(context, login.ca.c_str()) == 1);
  if (!login.certificate.empty()) {
    require(::SSL_CTX_use_certificate_chain_file(context, login.certificate.c_str()) == 1);
    require(::SSL_CTX_use_PrivateKey_file(context, login.key.c_str(), SSL_FILETYPE_PEM) == 1);
  }
  impl_->link.reset(::SSL_new(context));
  SSL* link = impl_->link.get();
  require(link != nullptr);
  // An address is checked as an address, anything else as a name.
  if (::X509_VERIFY_PARAM_set1_ip_asc(::SSL_get0_param(link), host.c_str()) != 1) {
    require(::SSL_set1_host(link, host.c_str()) == 1);
    SSL_set_tlsext_host_name(link, host.c_str());
  }
  const NoBrokenPipe guard;
  ::ERR_clear_error();
  require(::SSL_set_fd(link, socket) == 1);
  require(::SSL_connect(link) == 1, link);
}

TlsLink::~TlsLink() = default;

std::size_t TlsLink::read(char* buffer, std::size_t bytes) {
  ::ERR_clear_error();
  const int got = ::SSL_read(impl_->link.get(), buffer, static_cast<int>(std::min<std::size_t>(bytes, INT_MAX)));
  if (got > 0) return static_cast<std::size_t>(got);
  require(::SSL_get_error(impl_->link.get(), got) == SSL_ERROR_ZERO_RETURN);
  return 0;
}

std::size_t TlsLink::write(const char* bytes, std::size_t size) {
  const NoBrokenPipe guard;
  ::ERR_clear_error();
  const int sent = ::SSL_write(impl_->link.get(), bytes, static_cast<int>(std::min<std::size_t>(size, INT_MAX)));
  require(sent > 0);
  return static_cast<std::size_t>(sent);
}

bool TlsLink::pending() const {
  return ::SSL_pending(impl_->link.get()) > 0;
}

}  // namespace sculpt::client
