#include "server/access/access.hpp"

#include <spdlog/spdlog.h>

#include "proto/error_codes.hpp"
#include "server/base/config.hpp"
#include "server/base/time_stamp.hpp"

namespace sculpt::server {

namespace fs = std::filesystem;

Access::Access(const Config& config) : file_(config.tokens), certificates_(!config.tls_client_ca.empty()) {
  if (!has_tokens()) return;
  std::error_code error;
  read_at_ = fs::last_write_time(file_, error);
  tokens_ = read_tokens(file_);
}

Identity Access::identify(const Peer& peer, const std::string& token) {
  if (token.empty() || !has_tokens()) {
    if (peer.identity) return *peer.identity;
    throw proto::ProtocolError(
        "auth_required",
        "this server must know who you are: give \"token\" in hello (sculpt: set SCULPT_TOKEN), or "
        "HTTP's Authorization: Bearer TOKEN",
        "/params/token");
  }
  read_again_if_changed();
  if (const Token* found = find_token(tokens_, token, utc_text(unix_ms()))) return {found->name, found->scope};
  throw proto::ProtocolError("auth_required",
                             "the token is not known or has expired: ask the operator for one (sculptd token add)",
                             "/params/token");
}

// A file that cannot be read leaves the tokens as they were.
void Access::read_again_if_changed() {
  std::error_code error;
  const fs::file_time_type written = fs::last_write_time(file_, error);
  if (error || written == read_at_) return;
  try {
    tokens_ = read_tokens(file_);
    read_at_ = written;
  } catch (const ConfigError& fault) {
    spdlog::error("{}; the tokens read before stay valid", fault.what());
  }
}

void require_scope(const Identity& identity, Scope needed) {
  if (identity.scope >= needed) return;
  throw proto::ProtocolError("forbidden", std::string("this needs the scope ") + name(needed) + ", and you have " +
                                              name(identity.scope) + ": use a token with that scope");
}

}  // namespace sculpt::server
