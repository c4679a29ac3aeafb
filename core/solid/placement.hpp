// Where the target stands in the grid.
#pragma once

#include <optional>

#include "core/material/voxel.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

/// Default: scaled uniformly so that the largest side fills the grid less the margin, centred in x and y, standing on
/// the floor (z = 0 of the grid).
struct Placement {
  std::optional<double> scale_m;     ///< metres per unit of the mesh file; without it the mesh is made to fit
  Vec3 rotation_rad = Vec3::Zero();  ///< roll, pitch, yaw about the fixed x, y, z axes, applied before scaling
  Vec3 offset_m = Vec3::Zero();      ///< added after centring and standing on the floor
  double margin_m = 0;               ///< left free at each side and at the top when the mesh is made to fit
};

/// The mesh in metres in the stock frame. Throws InputError `placement_invalid` where scale or margin make no sense,
/// and `target_outside_stock` where a part of the mesh would be outside the grid (says by how much, and which option to
/// change).
Mesh place_mesh(const Mesh& mesh, const Placement& placement, const Grid& grid);

}  // namespace sculpt
