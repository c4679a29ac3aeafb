// Joint values are stored as whole numbers of quanta: 1e-7 rad or m, at most 0.1 um at the end of an arm of 1 m.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/base/frame.hpp"

namespace sculpt {

inline constexpr double quanta_per_unit = 1e7;
/// The most quanta that a value may have: up to here value -> quanta -> value is exact and their decimal text is
/// unique.
inline constexpr std::int64_t max_quanta = 1'000'000'000'000'000;

/// Dividing a whole number by 1e7 gives the double nearest to that decimal: exactly what its text is read back as.
inline double from_quanta(std::int64_t quanta) {
  return static_cast<double>(quanta) / quanta_per_unit;
}

/// Nothing for a value that is no multiple of the quantum, or beyond the most (NaN too).
inline std::optional<std::int64_t> to_quanta(double value) {
  const double scaled = value * quanta_per_unit;
  if (!(std::abs(scaled) <= static_cast<double>(max_quanta))) return {};
  const auto quanta = static_cast<std::int64_t>(scaled + (scaled < 0 ? -0.5 : 0.5));
  if (from_quanta(quanta) != value) return {};
  return quanta;
}

/// Joint values as they are stored: multiples of 1e-7 rad or m, so that the text read back gives the same double.
/// Planners certify rounded values.
Configuration rounded(const Configuration& q);
/// The same for a `q` within joint limits that need not be multiples themselves: what would be rounded past a limit is
/// rounded to the inside, less than one quantum away.
Configuration rounded(const Configuration& q, const Configuration& lower, const Configuration& upper);

}  // namespace sculpt
