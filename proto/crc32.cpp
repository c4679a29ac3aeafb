#include "proto/crc32.hpp"

#include <zlib.h>

namespace sculpt::proto {

std::string crc32_hex(std::string_view bytes) {
  const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  std::string hex(8, '0');
  for (int i = 0; i < 8; ++i) hex[static_cast<std::size_t>(i)] = "0123456789abcdef"[(sum >> (28 - 4 * i)) & 0xf];
  return hex;
}

}  // namespace sculpt::proto
