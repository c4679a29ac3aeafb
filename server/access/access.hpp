// Who may do what: identities, the tokens that prove them, and when nobody has to prove anything. I/O thread only.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/access/peer.hpp"
#include "server/access/tokens.hpp"

namespace sculpt::server {

struct Config;

class Access {
 public:
  /// Reads the tokens. Throws ConfigError.
  explicit Access(const Config& config);

  /// True when neither tokens nor client certificates are asked for: then all who reach the loopback address may do
  /// everything.
  bool open() const { return !has_tokens() && !certificates_; }
  bool has_tokens() const { return !file_.empty(); }

  /// The token's identity; without a token what is known of the peer. Throws ProtocolError `auth_required`.
  Identity identify(const Peer& peer, const std::string& token);

 private:
  void read_again_if_changed();

  std::filesystem::path file_;  // empty: none
  bool certificates_;
  std::vector<Token> tokens_;
  std::filesystem::file_time_type read_at_;
};

/// Throws ProtocolError `forbidden` unless the identity's scope reaches `needed`.
void require_scope(const Identity& identity, Scope needed);

}  // namespace sculpt::server
