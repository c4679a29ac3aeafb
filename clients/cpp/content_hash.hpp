// SHA-256 of content: the name of a blob.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>

namespace sculpt {

/// 64 lower-case hex digits.
std::string content_hash(std::string_view bytes);

struct StreamHash {
  std::string sha256;
  std::uint64_t size = 0;
};
/// From where the stream stands to its end.
StreamHash content_hash(std::istream& in);

}  // namespace sculpt
