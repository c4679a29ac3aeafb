// Closed-form distances between segments and boxes: exact, no iteration to a tolerance. Any one unit of length.
#pragma once

#include "core/base/frame.hpp"

namespace sculpt {

struct Segment {
  Vec3 a, b;
};

/// Smallest distance between two segments (Ericson, Real-Time Collision Detection, 5.1.9); degenerate segments are
/// points.
double distance(const Segment& first, const Segment& second);

/// Smallest distance between a segment and the solid box [low, high]; 0 where they meet.
double distance_to_box(const Segment& segment, const Vec3& low, const Vec3& high);

}  // namespace sculpt
