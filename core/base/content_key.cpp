#include "core/base/content_key.hpp"

#include <array>
#include <bit>
#include <fstream>
#include <vector>

namespace sculpt {
namespace {

std::string hash_program() {
  std::ifstream in("/proc/self/exe", std::ios::binary);
  Sha256 hash;
  std::vector<char> buffer(1 << 20);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)
    hash.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
  return hash.hex();
}

}  // namespace

void ContentKey::add(std::string_view text) {
  add(static_cast<std::uint64_t>(text.size()));
  hash_.add(text);
}

void ContentKey::add(std::uint64_t number) {
  const auto bytes = std::bit_cast<std::array<char, sizeof number>>(number);
  hash_.add({bytes.data(), bytes.size()});
}

void ContentKey::add(double value) {
  add(std::bit_cast<std::uint64_t>(value));
}

void ContentKey::add(const Vec3& v) {
  for (const double value : v) add(value);
}

const std::string& program_hash() {
  static const std::string hash = hash_program();
  return hash;
}

}  // namespace sculpt
