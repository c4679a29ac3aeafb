#pragma once

namespace sculpt {

constexpr double square(double value) {
  return value * value;
}

}  // namespace sculpt
