// Links to one file each, for programs that cannot send a token: who knows the link may read the file. I/O thread only.
#pragma once

#include <chrono>
#include <deque>
#include <string>

#include "proto/messages.hpp"

namespace sculpt::server {

inline constexpr std::chrono::minutes ticket_time{5};
inline const std::string links_path = "/v1/links/";  ///< then TICKET/NAME

class Tickets {
 public:
  using Clock = std::chrono::steady_clock;

  /// A new ticket, 256 random bits as hex digits. The oldest go where there are very many.
  std::string issue(const std::string& job, const std::string& artifact, const std::string& format,
                    Clock::time_point now);
  /// The file, from its first byte; throws ProtocolError `gone` for a ticket that has expired or never was.
  proto::ArtifactReadParams redeem(const std::string& ticket, Clock::time_point now) const;

 private:
  struct Ticket {
    std::string text;
    proto::ArtifactReadParams file;
    Clock::time_point end;
  };
  std::deque<Ticket> tickets_;  ///< in the order of their ends
};

}  // namespace sculpt::server
