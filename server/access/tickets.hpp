// Links to one file each, for programs that cannot send a token: who knows the link may read the file.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "proto/messages.hpp"

namespace sculpt::server {

inline constexpr std::chrono::minutes ticket_time{5};
inline const std::string links_path = "/v1/links/";  ///< then TICKET/NAME

/// A ticket says which file it is for and until when, and is signed: nothing is kept of it. Safe from any thread.
class Tickets {
 public:
  /// Tickets are good wherever they are read with the same `secret` and nearly the same `now_ms` (wall time): at all
  /// daemons of a fleet.
  Tickets(std::string secret, std::function<std::uint64_t()> now_ms)
      : secret_(std::move(secret)), now_ms_(std::move(now_ms)) {}

  /// JOB.ARTIFACT.FORMAT.PROGRAM.END.SIGNATURE, of letters, digits and dots.
  std::string issue(const proto::ArtifactReadParams& wanted) const;
  /// The file, from its first byte; throws ProtocolError `gone` for a ticket that has expired or never was.
  proto::ArtifactReadParams redeem(const std::string& ticket) const;

 private:
  std::string signature(const std::string& promise) const;

  std::string secret_;
  std::function<std::uint64_t()> now_ms_;
};

}  // namespace sculpt::server
