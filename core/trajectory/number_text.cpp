#include "core/trajectory/number_text.hpp"

#include <array>
#include <charconv>
#include <cstring>
#include <stdexcept>

#include "core/trajectory/quantum.hpp"

namespace sculpt {
namespace {

constexpr std::uint64_t one = 10'000'000;  // quanta

constexpr std::array<char, 200> digit_pairs = [] {
  std::array<char, 200> pairs{};
  for (std::size_t n = 0; n < 100; ++n) {
    pairs[2 * n] = static_cast<char>('0' + n / 10);
    pairs[2 * n + 1] = static_cast<char>('0' + n % 10);
  }
  return pairs;
}();

char* write_pair(char* out, std::uint64_t value) {
  std::memcpy(out, &digit_pairs[2 * value], 2);
  return out + 2;
}

// Where the shortest form has an exponent: 1e-07, 2e-04, 1e+05.
bool needs_exponent(std::uint64_t whole, std::uint64_t part) {
  if (whole >= 100'000) return true;
  return whole == 0 && part != 0 && part < 10'000 && (part < 1000 || part % 1000 == 0);
}

}  // namespace

char* write_number(char* out, double value) {
  const auto quanta = to_quanta(value);
  const auto size = static_cast<std::uint64_t>(quanta ? std::abs(*quanta) : 0);
  const std::uint64_t whole = size / one, part = size % one;
  if (!quanta || needs_exponent(whole, part)) {
    if (!std::isfinite(value)) throw std::invalid_argument("a trajectory value is not finite");
    return std::to_chars(out, out + longest_number, value).ptr;
  }
  if (*quanta < 0) *out++ = '-';
  if (whole < 10)
    *out++ = static_cast<char>('0' + whole);
  else
    out = std::to_chars(out, out + longest_number, whole).ptr;
  if (part == 0) return out;
  *out++ = '.';
  *out++ = static_cast<char>('0' + part / 1'000'000);
  out = write_pair(out, part / 10'000 % 100);
  out = write_pair(out, part / 100 % 100);
  out = write_pair(out, part % 100);
  while (out[-1] == '0') --out;
  return out;
}

}  // namespace sculpt
