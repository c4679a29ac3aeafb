// Counted randomness: every random number follows from a seed and a position, never from a thread or a clock.
#pragma once

#include <cstdint>

namespace sculpt {

/// Mixes two words into one (the finaliser of splitmix64, Steele et al., OOPSLA 2014).
constexpr std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
  std::uint64_t z = a + 0x9e3779b97f4a7c15ull * (b + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

/// splitmix64. Not shared between threads.
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}
  std::uint64_t next() { return mix(seed_, count_++); }
  /// In [0, 1).
  double unit() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  /// In [low, high).
  double between(double low, double high) { return low + (high - low) * unit(); }

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

}  // namespace sculpt
