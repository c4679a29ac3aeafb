// Is a body within a distance of another one, or of the material. The only door to FCL, with link_pairs.
#pragma once

#include "core/collision/body.hpp"
#include "core/collision/material.hpp"

namespace sculpt {

/// Could the two come within `reach_m` (m)? Bounding capsules rule most pairs out, FCL decides on shapes grown by the
/// reach; false only if they are farther apart. Poses of their links in one frame.
bool near_body(const Body& a, const Frame& pose_a, const Body& b, const Frame& pose_b, double reach_m);

/// A lower bound of their distance (m), in closed form from bounding capsules and boxes; 0 where it has none. Looks no
/// closer once it knows that it is `enough`.
double least_distance(const Body& a, const Frame& pose_a, const Body& b, const Frame& pose_b, double enough_m);

/// The same from the body to the grid's cube.
double least_distance_to_grid(const Body& body, const Frame& pose, const Grid& grid);

/// Could the body come within `reach_m` of a standing voxel? `pose`: its link in the stock frame.
bool near_material(const Body& body, const Frame& pose, const Material& material, const Grid& grid, double reach_m);

}  // namespace sculpt
