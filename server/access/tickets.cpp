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

constexpr std::size_t words = 5;  // of what is promised

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) c == '.' ? static_cast<void>(parts.emplace_back()) : static_cast<void>(parts.back() += c);
  return parts;
}

// Of what hex_of gave.
std::string text_of(const std::string& hex) {
  std::string text;
  for (std::size_t at = 0; at + 1 < hex.size(); at += 2) {
    int byte = 0;
    std::from_chars(&hex[at], &hex[at] + 2, byte, 16);
    text += static_cast<char>(byte);
  }
  return text;
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

std::string Tickets::issue(const proto::ArtifactReadParams& wanted) const {
  const auto end_ms = now_ms_() + std::chrono::duration_cast<std::chrono::milliseconds>(ticket_time).count();
  const std::string program = wanted.program ? hex_of(proto::write_json(to_json(*wanted.program))) : "";
  const std::string promise =
      wanted.job + "." + wanted.artifact + "." + wanted.format + "." + program + "." + std::to_string(end_ms);
  return promise + "." + signature(promise);
}

proto::ArtifactReadParams Tickets::redeem(const std::string& ticket) const {
  const std::string promise = ticket.substr(0, std::min(ticket.rfind('.'), ticket.size()));
  const std::vector<std::string> said = split(promise);
  const bool ours = is_equal(ticket, promise + "." + signature(promise)) && said.size() == words;
  std::uint64_t end_ms = 0;
  if (ours) std::from_chars(said[4].data(), said[4].data() + said[4].size(), end_ms);
  if (end_ms <= now_ms_())
    throw proto::ProtocolError("gone", "this link is good for five minutes, which are over: ask for another one");
  proto::ArtifactReadParams wanted{said[0], said[1], said[2], 0, 0};
  if (!said[3].empty()) wanted.program = proto::read_program({proto::parse_json(text_of(said[3])), "/params/program"});
  return wanted;
}

}  // namespace sculpt::server
