#include "server/http/http_guard.hpp"

#include <algorithm>
#include <cctype>

#include "server/net/net.hpp"

namespace sculpt::server {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

// Nothing, or a colon with digits or nothing behind it.
bool is_port(std::string_view text) {
  constexpr std::size_t max_digits = 5;
  if (text.empty()) return true;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return text.front() == ':' && text.size() <= 1 + max_digits && std::ranges::all_of(text.substr(1), is_digit);
}

}  // namespace

std::string host_of(std::string_view authority) {
  const bool v6 = authority.starts_with('[');
  const std::size_t end = std::min(authority.find(v6 ? ']' : ':'), authority.size());
  if (v6 && end == authority.size()) return {};
  const std::string_view host = v6 ? authority.substr(1, end - 1) : authority.substr(0, end);
  return is_port(authority.substr(v6 ? end + 1 : end)) ? lower(host) : std::string();
}

bool host_allowed(std::string_view host_header, const std::vector<std::string>& names) {
  const std::string host = host_of(host_header);
  if (host.empty()) return false;
  if (host == "localhost") return true;
  boost::system::error_code error;
  const net::ip::address address = net::ip::make_address(host, error);
  if (!error && address.is_loopback()) return true;
  return std::ranges::any_of(names, [&](const std::string& name) { return lower(name) == host; });
}

bool origin_allowed(std::string_view origin, std::string_view host_header, const std::vector<std::string>& origins) {
  if (origin.empty()) return true;
  const std::size_t scheme = origin.find("://");
  if (scheme != std::string_view::npos && lower(origin.substr(scheme + 3)) == lower(host_header)) return true;
  return std::ranges::find(origins, origin) != origins.end();
}

}  // namespace sculpt::server
