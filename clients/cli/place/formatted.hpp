// printf into a string.
#pragma once

#include <cstdio>
#include <string>

namespace sculpt::cli {

/// Cut off after 511 bytes.
template <typename... Values>
std::string formatted(const char* format, Values... values) {
  char text[512];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace sculpt::cli
