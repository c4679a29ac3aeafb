// SHA-256 of content: the name of a blob, and what an artifact must have.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace sculpt::client {

/// Of what is added piece by piece. Throws std::runtime_error where OpenSSL fails.
class ContentHash {
 public:
  ContentHash();
  void add(std::string_view bytes);
  /// 64 lower-case hex digits. Once, at the end.
  std::string hex();

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/// 64 lower-case hex digits.
std::string content_hash(std::string_view bytes);

struct StreamHash {
  std::string sha256;
  std::uint64_t size = 0;
};
/// From where the stream stands to its end.
StreamHash content_hash(std::istream& in);

}  // namespace sculpt::client
