// Config -> TLS context.
#pragma once

#include <memory>

namespace boost::asio::ssl {
class context;
}

namespace sculpt::server {

struct Config;

/// TLS 1.2 or newer with the configured certificate; with `tls_client_ca` a client may show a certificate of that
/// authority, and must where there are no tokens. Null: TLS is not configured. Throws ConfigError naming the file.
std::shared_ptr<boost::asio::ssl::context> make_tls(const Config& config);

}  // namespace sculpt::server
