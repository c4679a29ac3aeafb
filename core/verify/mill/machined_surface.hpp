// A plan with milling tools -> the part's surface as it leaves it. Measured as the replay measures at random points,
// and like it shares nothing with how the plan was made.
#pragma once

#include <iosfwd>
#include <vector>

#include "core/base/watch.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"

namespace sculpt {

struct MachinedSurface {
  Mesh mesh;                     ///< the part's (m, stock frame), each vertex where what stands above it ends
  std::vector<double> excess_m;  ///< of each vertex: what stands above it, along the outward normal
};

/// Of a trajectory of format 2. `part`: placed, in metres, in the stock frame; its edges are made no longer than a
/// 256th of the block's, and triangles that lie inside of the target are left out. A ball counts as smaller by what the
/// plan may stray. `watch` is told in voxels removed. Throws InputError `trajectory_invalid`; Cancelled.
MachinedSurface machined_surface(std::istream& plan, Mesh part, const VoxelGrid& voxels, const Grid& grid,
                                 const Watch& watch);

}  // namespace sculpt
