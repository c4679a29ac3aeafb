// Is a body within a distance of another one, or of the material. The only door to FCL, with link_pairs.
#pragma once

#include <optional>
#include <vector>

#include "core/collision/material.hpp"
#include "core/collision/shape/body.hpp"

namespace sculpt {

/// Could the two come within `reach_m` (m)? Bounding capsules rule most pairs out, FCL decides on shapes grown by the
/// reach; false only if they are farther apart. Poses of their links in one frame.
bool near_body(const Body& a, const Frame& pose_a, const Body& b, const Frame& pose_b, double reach_m);

/// A lower bound of their distance (m), in closed form from bounding capsules and boxes; 0 where it has none. Looks no
/// closer once it knows that it is `enough`.
double least_distance(const Body& a, const Frame& pose_a, const Body& b, const Frame& pose_b, double enough_m);

/// The same from the body to the grid's cube.
double least_distance_to_grid(const Body& body, const Frame& pose, const Grid& grid);

/// A capsule around a piece of a body, and a plane that lies between it and something convex.
struct Separation {
  Capsule capsule;
  Vec3 normal;   ///< of the plane, towards the capsule
  double gap_m;  ///< between the two, along the normal
};

/// Separations of all pieces of `a` from all of `b` that may be nearer than `enough_m` (m); nothing if some have no
/// plane between them that is found in closed form, or if they are many. Frame of the poses.
std::optional<std::vector<Separation>> separations(const Body& a, const Frame& pose_a, const Body& b,
                                                   const Frame& pose_b, double enough_m);

/// The same from the grid's cube. `pose` in the stock frame.
std::optional<std::vector<Separation>> separations_from_grid(const Body& body, const Frame& pose, const Grid& grid,
                                                             double enough_m);

/// Could the body come within `reach_m` of a standing voxel? `pose`: its link in the stock frame.
bool near_material(const Body& body, const Frame& pose, const Material& material, const Grid& grid, double reach_m);

}  // namespace sculpt
