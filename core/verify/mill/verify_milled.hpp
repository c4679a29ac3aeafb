// A plan with milling tools -> verdict. Shares nothing with how it was planned.
#pragma once

#include <iosfwd>

#include "core/base/watch.hpp"
#include "core/cell/cell.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/mesh/mesh.hpp"
#include "core/verify/verify.hpp"

namespace sculpt {

/// What is asked of a plan beside its file.
struct MilledPart {
  Mesh mesh;                ///< placed, in metres, in the stock frame
  std::string mesh_sha256;  ///< of its file's bytes
};

/// Replays a trajectory of format 2. Clean means: header and cell agree, it starts and ends at home, limits are kept,
/// tools are changed at rest where they touch nothing, the tip is where each keyframe says and strays no farther from
/// the straight way than the header allows, each cut removes as many voxels as it says, no cutter is ever inside the
/// part by more than a micrometre, no chip is thicker than the tool's depth times width of cut (10 % and what a voxel
/// makes of it added) on level cuts, and nothing else of tool and robot touches what may stand, the room or itself.
/// Throws InputError `trajectory_invalid`; Cancelled.
/// `threads`: above one, the surface is looked at beside the rest; the verdict is the same.
Verdict verify_milled(std::istream& in, const Cell& cell, const VoxelGrid& voxels, const MilledPart& part, int threads,
                      const Watch& watch);

}  // namespace sculpt
