// Closed-form distances between segments and boxes: exact, no iteration to a tolerance. Any one unit of length.
#pragma once

#include "core/base/frame.hpp"

namespace sculpt {

struct Segment {
  Vec3 a, b;
};

/// The shortest way from the second segment to the first (Ericson, Real-Time Collision Detection, 5.1.9); degenerate
/// segments are points.
Vec3 separation(const Segment& first, const Segment& second);

/// The shortest way from the solid box [low, high] to a segment; zero where they meet.
Vec3 separation_from_box(const Segment& segment, const Vec3& low, const Vec3& high);

inline double distance(const Segment& first, const Segment& second) {
  return separation(first, second).norm();
}

inline double distance_to_box(const Segment& segment, const Vec3& low, const Vec3& high) {
  return separation_from_box(segment, low, high).norm();
}

}  // namespace sculpt
