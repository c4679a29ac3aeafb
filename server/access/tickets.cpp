#include "server/access/tickets.hpp"

#include <algorithm>

#include "proto/error_codes.hpp"
#include "server/access/secret.hpp"

namespace sculpt::server {
namespace {

constexpr int ticket_bytes = 32;
constexpr std::size_t most_tickets = 10000;

}  // namespace

std::string Tickets::issue(const std::string& job, const std::string& artifact, const std::string& format,
                           Clock::time_point now) {
  while (!tickets_.empty() && (tickets_.front().end <= now || tickets_.size() == most_tickets)) tickets_.pop_front();
  tickets_.push_back({random_hex(ticket_bytes), {job, artifact, format, 0, 0}, now + ticket_time});
  return tickets_.back().text;
}

proto::ArtifactReadParams Tickets::redeem(const std::string& ticket, Clock::time_point now) const {
  const auto found = std::ranges::find(tickets_, ticket, &Ticket::text);
  if (found == tickets_.end() || found->end <= now)
    throw proto::ProtocolError("gone", "this link is good for five minutes, which are over: ask for another one");
  return found->file;
}

}  // namespace sculpt::server
