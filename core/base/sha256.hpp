// Content hashes (OpenSSL).
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace sculpt {

/// A running SHA-256. Not shared between threads. The first of a process takes a millisecond, in which OpenSSL starts:
/// on the thread that first adds something.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  void add(std::string_view bytes);
  /// 64 lower-case hex digits of everything added so far; the object may not be used afterwards.
  std::string hex();
  /// The same, and more may be added.
  std::string hex_so_far();

 private:
  void begin();

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

std::string sha256_hex(std::string_view bytes);

}  // namespace sculpt
