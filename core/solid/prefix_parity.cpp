#include "core/solid/prefix_parity.hpp"

#include <algorithm>
#include <array>

namespace sculpt {
namespace {

/// The bits of a word that have at least `shift` bits of their own span (a power of two of bits) below them.
std::uint64_t reach_of(std::size_t shift, std::size_t span) {
  std::uint64_t reach = 0;
  for (std::size_t bit = 0; bit < 64; ++bit)
    if (bit % span >= shift) reach |= std::uint64_t{1} << bit;
  return reach;
}

/// Columns that step from bit to bit inside a word.
void prefix_parity_narrow(Words& words, std::size_t stride, std::size_t span) {
  const std::size_t in_word = std::min<std::size_t>(span, 64), words_a_span = span / in_word;
  std::array<std::uint64_t, 7> reach{};
  for (std::size_t s = 0; stride << s < in_word; ++s) reach[s] = reach_of(stride << s, in_word);
  std::uint64_t repeat = 0;  // copies the lowest `stride` bits all over a word
  for (std::size_t bit = 0; bit < 64; bit += stride) repeat |= std::uint64_t{1} << bit;
  for (std::size_t first = 0; first < words.size(); first += words_a_span) {
    std::uint64_t carry = 0;
    for (std::size_t at = first; at < first + words_a_span; ++at) {
      std::uint64_t word = words[at];
      for (std::size_t s = 0; stride << s < in_word; ++s) word ^= (word << (stride << s)) & reach[s];
      words[at] = word ^ (carry * repeat);
      carry = words[at] >> (64 - stride);
    }
  }
}

}  // namespace

void prefix_parity(Words& words, std::size_t stride, std::size_t span) {
  if (stride < 64) return prefix_parity_narrow(words, stride, span);
  const std::size_t step = stride / 64, block = span / 64;
  for (std::size_t first = 0; first < words.size(); first += block)
    for (std::size_t at = first + step; at < first + block; ++at) words[at] ^= words[at - step];
}

}  // namespace sculpt
