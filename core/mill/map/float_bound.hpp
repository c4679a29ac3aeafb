// Bounds of heights in single precision.
#pragma once

#include <cmath>
#include <limits>

namespace sculpt {

/// The next float that is surely not below (m).
inline float above(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}
/// The next float that is surely not above (m).
inline float below(double value) {
  return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity());
}

}  // namespace sculpt
