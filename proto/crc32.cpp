#include "proto/crc32.hpp"

#include <array>
#include <cstdint>

namespace sculpt {
namespace {

constexpr std::array<std::uint32_t, 256> make_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t rest = i;
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ ((rest & 1) != 0 ? 0xedb88320u : 0u);
    table[i] = rest;
  }
  return table;
}

constexpr auto table = make_table();

}  // namespace

std::string crc32_hex(std::string_view bytes) {
  std::uint32_t sum = 0xffffffffu;
  for (const char c : bytes) sum = table[(sum ^ static_cast<std::uint8_t>(c)) & 0xff] ^ (sum >> 8);
  sum = ~sum;
  std::string hex(8, '0');
  for (int i = 0; i < 8; ++i) hex[static_cast<std::size_t>(i)] = "0123456789abcdef"[(sum >> (28 - 4 * i)) & 0xf];
  return hex;
}

}  // namespace sculpt
