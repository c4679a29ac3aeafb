// Shape -> FCL geometry. Internal to collision/: the FCL world is in millimetres, because FCL's tolerances are absolute
// and sized for that.
#pragma once

#include <fcl/fcl.h>

#include <memory>

#include "core/cell/robot.hpp"

namespace sculpt {

inline constexpr double fcl_mm = 1000;

/// The shape grown by `grow_m` on all sides (a little more at edges and corners), or shrunk if it is below 0, to next
/// to nothing at most; meshes stay as they are.
std::shared_ptr<fcl::CollisionGeometryd> make_fcl_geometry(const Shape& shape, double grow_m);

inline Frame to_fcl(const Frame& pose) {
  Frame scaled = pose;
  scaled.translation() *= fcl_mm;
  return scaled;
}

/// True when the two touch. Poses as `to_fcl` gives them.
bool fcl_touch(const fcl::CollisionGeometryd& a, const Frame& pose_a, const fcl::CollisionGeometryd& b,
               const Frame& pose_b);

/// Distance in mm of the surfaces, 0 or less where they meet. Poses as `to_fcl` gives them.
double fcl_distance_mm(const fcl::CollisionGeometryd& a, const Frame& pose_a, const fcl::CollisionGeometryd& b,
                       const Frame& pose_b);

}  // namespace sculpt
