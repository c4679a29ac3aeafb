#include "core/doctor/metres.hpp"

#include <cstdio>

namespace sculpt {

std::string in_metres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", metres);
  return text;
}

}  // namespace sculpt
