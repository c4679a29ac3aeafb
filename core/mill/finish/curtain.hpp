// What is above a straight way of a cutter's middle, against triangles.
#pragma once

#include <array>

#include "core/base/frame.hpp"

namespace sculpt {

/// All points (from + t way) + (0, 0, s), s >= 0, in a tool's frame (m).
class Curtain {
 public:
  Curtain(const Vec3& from, const Vec3& to);

  /// Is any of it nearer to a triangle than this (m^2)? `normal`: unit, not downwards.
  bool is_nearer(const std::array<Vec3, 3>& t, const Vec3& normal, double distance2) const;

 private:
  double above_distance2(const Vec3& point) const;
  bool crosses(const Vec3& a, const Vec3& b) const;

  Vec3 from_, way_;
  double plan2_;  ///< of its length from above (m^2)
};

}  // namespace sculpt
