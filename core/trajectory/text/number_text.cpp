#include "core/trajectory/text/number_text.hpp"

#include <algorithm>
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

// Where the shortest form has one: 1e-07, 2e-04.
bool needs_exponent(std::uint64_t whole, std::uint64_t part) {
  return whole == 0 && part != 0 && part < 10'000 && (part < 1000 || part % 1000 == 0);
}

// Of `part` quanta: its digits, the first before the point, without zeros at the end.
char* write_with_exponent(char* out, std::uint64_t part) {
  int exponent = -7;
  for (; part % 10 == 0; part /= 10) ++exponent;
  std::array<char, 20> digits;
  const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), part).ptr;
  *out++ = digits[0];
  if (end > digits.data() + 1) *out++ = '.';
  out = std::copy<const char*>(digits.data() + 1, end, out);
  exponent += static_cast<int>(end - digits.data()) - 1;
  *out++ = 'e';
  *out++ = '-';
  *out++ = '0';
  *out++ = static_cast<char>('0' - exponent);
  return out;
}

}  // namespace

char* write_number(char* out, double value) {
  const auto quanta = to_quanta(value);
  const auto size = static_cast<std::uint64_t>(quanta ? std::abs(*quanta) : 0);
  const std::uint64_t whole = size / one, part = size % one;
  if (!quanta || whole >= 100'000) {
    if (!std::isfinite(value)) throw std::invalid_argument("a trajectory value is not finite");
    return std::to_chars(out, out + max_number_bytes, value).ptr;
  }
  if (*quanta < 0) *out++ = '-';
  if (needs_exponent(whole, part)) return write_with_exponent(out, part);
  if (whole < 10)
    *out++ = static_cast<char>('0' + whole);
  else
    out = std::to_chars(out, out + max_number_bytes, whole).ptr;
  if (part == 0) return out;
  const auto digits = static_cast<std::uint32_t>(part), first = digits / 10'000, last = digits - first * 10'000;
  const std::uint32_t hundreds = first / 100, tens = last / 100;
  *out++ = '.';
  *out++ = static_cast<char>('0' + hundreds);
  out = write_pair(out, first - hundreds * 100);
  out = write_pair(out, tens);
  out = write_pair(out, last - tens * 100);
  while (out[-1] == '0') --out;
  return out;
}

void append_number(std::string& text, double value) {
  std::array<char, max_number_bytes> digits;
  text.append(digits.data(), write_number(digits.data(), value));
}

}  // namespace sculpt
