#include "clients/cpp/content_hash.hpp"

#include <openssl/evp.h>

#include <array>
#include <istream>
#include <stdexcept>
#include <vector>

namespace sculpt::client {
namespace {

constexpr std::size_t read_bytes = 1 << 20;

[[noreturn]] void refuse() {
  throw std::runtime_error("OpenSSL cannot compute SHA-256");
}

}  // namespace

ContentHash::ContentHash() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
  if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) refuse();
}

void ContentHash::add(std::string_view bytes) {
  if (EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) != 1) refuse();
}

std::string ContentHash::hex() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_DigestFinal_ex(context_.get(), digest.data(), &size) != 1) refuse();
  std::string text;
  for (unsigned int i = 0; i < size; ++i) {
    text += "0123456789abcdef"[digest[i] >> 4];
    text += "0123456789abcdef"[digest[i] & 15];
  }
  return text;
}

std::string content_hash(std::string_view bytes) {
  ContentHash hash;
  hash.add(bytes);
  return hash.hex();
}

StreamHash content_hash(std::istream& in) {
  ContentHash hash;
  StreamHash result;
  std::vector<char> buffer(read_bytes);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0) {
    hash.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
    result.size += static_cast<std::uint64_t>(in.gcount());
  }
  result.sha256 = hash.hex();
  return result;
}

}  // namespace sculpt::client
