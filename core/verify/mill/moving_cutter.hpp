// A cutter on a straight way, against triangles. Internal to verify/. Millimetres, stock frame.
#pragma once

#include <array>

#include "core/base/frame.hpp"
#include "core/cell/milling/mill_tool.hpp"

namespace sculpt {

/// Its end and all that is above it, as high as the flutes. Immutable.
class MovingCutter {
 public:
  /// From one tip to the other; `axis` towards the spindle.
  MovingCutter(const Cutter& cutter, const Vec3& axis, const Vec3& from, const Vec3& to);

  /// What is no farther from it than this lies in here.
  Eigen::AlignedBox3d box(double more_mm) const;
  /// False where what is inside of a ball is surely farther from it than this.
  bool is_near(const Vec3& middle, double radius, double more_mm) const;
  /// How deep a triangle is inside of it: 0 or less if it stays out by so much. Of rims other than a ball's a little
  /// more.
  double depth(const std::array<Vec3, 3>& t) const;

 private:
  bool is_ball_;
  double radius_, corner_, flute_;
  Vec3 axis_, from_, to_, base_from_, base_to_, level_;  ///< bases: middles of a ball or a rim
  double lowest_base_, top_;
};

}  // namespace sculpt
