// Places of a milling tool's tip as plans write them: whole numbers.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/base/frame.hpp"
#include "core/trajectory/quantum.hpp"

namespace sculpt {

/// A point in quanta (1e-7 m) of the stock frame.
using QuantaPoint = std::array<std::int64_t, 3>;

/// The nearest one to a point (m).
inline QuantaPoint quanta_of(const Vec3& point) {
  return {std::llround(point.x() * quanta_per_unit), std::llround(point.y() * quanta_per_unit),
          std::llround(point.z() * quanta_per_unit)};
}

/// Where it is (m).
inline Vec3 point_of(const QuantaPoint& quanta) {
  return {from_quanta(quanta[0]), from_quanta(quanta[1]), from_quanta(quanta[2])};
}

}  // namespace sculpt
