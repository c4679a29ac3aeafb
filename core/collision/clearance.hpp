// Is a body within a distance of another one, or of the material.
#pragma once

#include "core/collision/material.hpp"
#include "core/collision/shape/body.hpp"

namespace sculpt {

/// Could the two come within `reach_m` (m)? False only if there is a plane between every two of their parts with more
/// than that between. Poses of their links in one frame.
bool near_body(const Body& a, const Frame& pose_a, const Body& b, const Frame& pose_b, double reach_m);
/// The same of all that `a` passes as it slides, without turning, from `slide` before its pose to as far behind it.
/// `slide`: in the frame of b's link.
bool near_sliding_body(const Body& a, const Frame& pose_a, const Vec3& slide, const Body& b, const Frame& pose_b,
                       double reach_m);

/// A lower bound of their distance by their hulls alone (m), below 0 where these overlap.
double hull_distance(const Body& a, const Frame& pose_a, const Body& b, const Frame& pose_b);

/// Could the body come within `reach_m` of a standing voxel? `pose`: its link in the stock frame.
bool near_material(const Body& body, const Frame& pose, const Material& material, const Grid& grid, double reach_m);

/// All that stands, a body of `stock_link`: cubes, those of the 32nd part of the grid's edge full where anything stands
/// in them.
Body make_stock_body(const Material& material, const Grid& grid, int stock_link);

}  // namespace sculpt
