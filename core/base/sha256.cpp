#include "core/base/sha256.hpp"

#include <openssl/evp.h>

#include <array>
#include <new>

namespace sculpt {

namespace {

std::string final_hex(EVP_MD_CTX* context) {
  std::array<unsigned char, 32> digest{};
  EVP_DigestFinal_ex(context, digest.data(), nullptr);
  std::string text;
  for (unsigned char byte : digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

}  // namespace

struct Sha256::Impl {
  ~Impl() { EVP_MD_CTX_free(context); }
  EVP_MD_CTX* context = EVP_MD_CTX_new();
};

Sha256::Sha256() = default;
Sha256::~Sha256() = default;

void Sha256::begin() {
  if (impl_) return;
  impl_ = std::make_unique<Impl>();
  if (impl_->context == nullptr || EVP_DigestInit_ex(impl_->context, EVP_sha256(), nullptr) != 1)
    throw std::bad_alloc();
}

void Sha256::add(std::string_view bytes) {
  begin();
  EVP_DigestUpdate(impl_->context, bytes.data(), bytes.size());
}

std::string Sha256::hex() {
  begin();
  return final_hex(impl_->context);
}

std::string Sha256::hex_so_far() {
  begin();
  const Impl copy;
  if (copy.context == nullptr || EVP_MD_CTX_copy_ex(copy.context, impl_->context) != 1) throw std::bad_alloc();
  return final_hex(copy.context);
}

std::string sha256_hex(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.hex();
}

}  // namespace sculpt
