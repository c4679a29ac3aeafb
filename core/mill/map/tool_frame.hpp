// The stock as a milling tool sees it: u and v across the axis, w along it.
#pragma once

#include <array>
#include <cmath>

#include "core/base/frame.hpp"

namespace sculpt {

/// A direction of the tool's axis in whole numbers, from the tip towards the spindle: plans are exact about it.
using Direction = std::array<int, 3>;

/// A place across a tool's axis.
using Point2 = Eigen::Vector2d;

/// Coordinates about the stock frame's origin.
struct ToolFrame {
  explicit ToolFrame(const Direction& along)
      : direction(along), w(Vec3(along[0], along[1], along[2]).normalized()), u(w.unitOrthogonal()), v(w.cross(u)) {}

  /// Of a point of the stock frame (m).
  Vec3 of(const Vec3& point) const { return {u.dot(point), v.dot(point), w.dot(point)}; }
  /// Back.
  Vec3 point(const Vec3& at) const { return u * at.x() + v * at.y() + w * at.z(); }

  Direction direction;
  Vec3 w, u, v;  ///< unit vectors
};

}  // namespace sculpt
