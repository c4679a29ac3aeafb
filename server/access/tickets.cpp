#include "server/access/tickets.hpp"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <charconv>
#include <stdexcept>
#include <vector>

#include "proto/error_codes.hpp"
#include "server/access/secret.hpp"

namespace sculpt::server {
namespace {

constexpr std::size_t words = 4;  // of what is promised

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) c == '.' ? static_cast<void>(parts.emplace_back()) : static_cast<void>(parts.back() += c);
  return parts;
}

bool is_equal(const std::string& a, const std::string& b) {
  return a.size() == b.size() && ::CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace

std::string Tickets::signature(const std::string& promise) const {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned int size = 0;
  if (::HMAC(::EVP_sha256(), secret_.data(), static_cast<int>(secret_.size()),
             reinterpret_cast<const unsigned char*>(promise.data()), promise.size(), bytes.data(), &size) == nullptr)
    throw std::runtime_error("a link cannot be signed: OpenSSL has no SHA-256");
  return hex_of({reinterpret_cast<const char*>(bytes.data()), size});
}

std::string Tickets::issue(const std::string& job, const std::string& artifact, const std::string& format) const {
  const auto end_ms = now_ms_() + std::chrono::duration_cast<std::chrono::milliseconds>(ticket_time).count();
  const std::string promise = job + "." + artifact + "." + format + "." + std::to_string(end_ms);
  return promise + "." + signature(promise);
}

proto::ArtifactReadParams Tickets::redeem(const std::string& ticket) const {
  const std::string promise = ticket.substr(0, std::min(ticket.rfind('.'), ticket.size()));
  const std::vector<std::string> said = split(promise);
  const bool ours = is_equal(ticket, promise + "." + signature(promise)) && said.size() == words;
  std::uint64_t end_ms = 0;
  if (ours) std::from_chars(said[3].data(), said[3].data() + said[3].size(), end_ms);
  if (end_ms <= now_ms_())
    throw proto::ProtocolError("gone", "this link is good for five minutes, which are over: ask for another one");
  return {said[0], said[1], said[2], 0, 0};
}

}  // namespace sculpt::server
