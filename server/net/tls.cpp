#include "server/net/tls.hpp"

#include <filesystem>
#include <string_view>

#include "server/base/config.hpp"
#include "server/net/net.hpp"

// Behind net.hpp.
#include <boost/asio/ssl/context.hpp>

namespace sculpt::server {
namespace {

namespace ssl = net::ssl;

void require_good(const boost::system::error_code& error, const char* setting, const std::filesystem::path& file) {
  if (!error) return;
  throw ConfigError(std::string(setting) + ": cannot use the file '" + file.string() + "': " + error.message() +
                    "; it must be PEM and readable by this user");
}

void ask_for_certificates(ssl::context& context, const Config& config) {
  boost::system::error_code error;
  context.load_verify_file(config.tls_client_ca.string(), error);
  require_good(error, "tls_client_ca", config.tls_client_ca);
  const bool must = config.tokens.empty();
  context.set_verify_mode(must ? ssl::verify_peer | ssl::verify_fail_if_no_peer_cert : ssl::verify_peer, error);
  require_good(error, "tls_client_ca", config.tls_client_ca);
  // Without a name of its own OpenSSL refuses to resume a session that has a client certificate.
  constexpr std::string_view name = "sculptd";
  ::SSL_CTX_set_session_id_context(context.native_handle(), reinterpret_cast<const unsigned char*>(name.data()),
                                   name.size());
}

}  // namespace

std::shared_ptr<ssl::context> make_tls(const Config& config) {
  if (config.tls_certificate.empty() && config.tls_key.empty() && config.tls_client_ca.empty()) return nullptr;
  if (config.tls_certificate.empty() || config.tls_key.empty()) {
    throw ConfigError("TLS needs both the settings tls_certificate and tls_key");
  }
  auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
  ::SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  boost::system::error_code error;
  context->use_certificate_chain_file(config.tls_certificate.string(), error);
  require_good(error, "tls_certificate", config.tls_certificate);
  context->use_private_key_file(config.tls_key.string(), ssl::context::pem, error);
  require_good(error, "tls_key", config.tls_key);
  if (!config.tls_client_ca.empty()) ask_for_certificates(*context, config);
  return context;
}

}  // namespace sculpt::server
