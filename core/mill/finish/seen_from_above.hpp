// Triangles seen along a tool's axis.
#pragma once

#include <array>

#include "core/base/frame.hpp"

namespace sculpt {

/// Of a unit normal along the axis: what is less stands upright.
inline constexpr double upright = 1e-9;

/// Is (u, v) inside of the triangle?
inline bool covers(const std::array<Vec3, 3>& t, double u, double v) {
  const auto turn = [&](const Vec3& a, const Vec3& b) {
    return (b.x() - a.x()) * (v - a.y()) - (b.y() - a.y()) * (u - a.x());
  };
  const double x = turn(t[0], t[1]), y = turn(t[1], t[2]), z = turn(t[2], t[0]);
  return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
}

}  // namespace sculpt
