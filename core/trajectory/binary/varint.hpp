// Whole numbers as seven bits a byte, lowest first. Internal to trajectory/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace sculpt {

inline constexpr std::size_t max_varint_bytes = 10;

inline std::uint64_t zigzag(std::int64_t value) {
  return static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
}

inline std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1 ^ (0 - (value & 1)));
}

/// There must be room for max_varint_bytes; gives what is behind those that it took.
inline char* write_varint(char* out, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) *out++ = static_cast<char>(value | 0x80);
  *out++ = static_cast<char>(value);
  return out;
}

inline void append_varint(std::string& out, std::uint64_t value) {
  char bytes[max_varint_bytes];
  out.append(bytes, write_varint(bytes, value));
}

}  // namespace sculpt
