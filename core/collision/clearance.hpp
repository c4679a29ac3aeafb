// Is a body within a distance of another one, or of the material. The only door to FCL, with link_pairs.
#pragma once

#include "core/collision/body.hpp"
#include "core/collision/material.hpp"

namespace sculpt {

/// Could the two come within `reach_m` (m)? Bounding capsules rule most pairs out, FCL decides on shapes grown by the
/// reach; false only if they are farther apart. Poses of their links in one frame.
bool near_body(const Body& a, const Frame& pose_a, const Body& b, const Frame& pose_b, double reach_m);

/// Could the body come within `reach_m` of a standing voxel? `pose`: its link in the stock frame.
bool near_material(const Body& body, const Frame& pose, const Material& material, const Grid& grid, double reach_m);

}  // namespace sculpt
