// Numbers as programs have them: never with an exponent, never -0. Internal to core/program/write.
#pragma once

#include <charconv>
#include <numbers>
#include <string>

#include "core/program/axis_layout.hpp"

namespace sculpt {

inline void append_fixed(std::string& text, double value, int decimals) {
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals).ptr;
  std::string_view written(digits, static_cast<std::size_t>(end - digits));
  if (written.find_first_not_of("-0.") == std::string_view::npos && written.front() == '-') written.remove_prefix(1);
  text += written;
}

/// Degrees and millimetres.
inline double in_degrees_or_mm(const AxisLayout::Axis& axis, double value) {
  return axis.turns ? value * 180 / std::numbers::pi : value * 1000;
}

}  // namespace sculpt
