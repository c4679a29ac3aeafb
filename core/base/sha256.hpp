// Content hashes. By Nettle: it has nothing to start, where OpenSSL takes more than a millisecond, a twentieth of a
// short plan.
#pragma once

#include <nettle/sha2.h>

#include <string>
#include <string_view>

namespace sculpt {

/// A running SHA-256. Not shared between threads.
class Sha256 {
 public:
  Sha256();
  void add(std::string_view bytes);
  /// 64 lower-case hex digits of everything added so far.
  std::string hex() const;

 private:
  sha256_ctx context_;
};

std::string sha256_hex(std::string_view bytes);

}  // namespace sculpt
