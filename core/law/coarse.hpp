// Numbers of a time law as its file has them: 16 bits, 5 of them exponent. Rounded down: slower and shorter is safe.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sculpt {

inline constexpr int coarse_mantissa_bits = 11, coarse_lowest_exponent = -26, coarse_exponents = 32;

/// 0 for what is too small to be written; what is too large becomes the largest.
inline std::uint16_t to_coarse(double value) {
  constexpr int steps = 1 << coarse_mantissa_bits;
  if (!(value >= std::ldexp(1.0 + 1.0 / steps, coarse_lowest_exponent))) return 0;
  int exponent = 0;
  const double mantissa = 2 * std::frexp(value, &exponent);  // 1 to 2
  --exponent;
  if (exponent >= coarse_lowest_exponent + coarse_exponents) return 0xffff;
  const int fraction = std::min(steps - 1, static_cast<int>(std::floor((mantissa - 1) * steps)));
  return static_cast<std::uint16_t>((exponent - coarse_lowest_exponent) << coarse_mantissa_bits | fraction);
}

inline double from_coarse(std::uint16_t bits) {
  constexpr int steps = 1 << coarse_mantissa_bits;
  if (bits == 0) return 0;
  return std::ldexp(1.0 + static_cast<double>(bits % steps) / steps,
                    (bits >> coarse_mantissa_bits) + coarse_lowest_exponent);
}

/// The largest number that 16 bits can say and that is no larger than `value`.
inline double rounded_down(double value) {
  return from_coarse(to_coarse(value));
}

}  // namespace sculpt
