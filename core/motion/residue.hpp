// Why a voxel was left.
#pragma once

#include <vector>

#include "core/base/helpers.hpp"
#include "core/base/watch.hpp"
#include "core/collision/scene.hpp"
#include "core/material/voxel_grid.hpp"

namespace sculpt {

/// The last five: the tool cannot come to it, but could if what was left for that other reason were gone.
enum class Reason {
  enclosed,
  tool_cannot_reach,
  out_of_reach,
  joint_limits,
  link_collision,
  no_transit,
  loose_piece,
  behind_out_of_reach,
  behind_joint_limits,
  behind_link_collision,
  behind_no_transit,
  behind_loose_piece
};

/// "enclosed", "tool cannot reach", "out of reach", "joint limits", "link collision", "no transit", "would free a loose
/// piece", "behind voxels left for" with "reach", "joint limits", "link collision", "no transit" or "a loose piece".
const char* name(Reason reason);

struct Residue {
  Voxel voxel;
  Reason reason;
};

/// The remove voxels of `voxels` that still stand in `scene`, in index order, each with the first condition that no
/// tool axis meets in the final state: joined to the outside; room for ball, shank and holder; a configuration at all;
/// one within limits; one without contact. What meets all of them was left because its removal would free a loose
/// piece, or else for want of a transit. What only stands behind such voxels says so. `may_fall`: what cannot be held.
/// Throws Cancelled.
std::vector<Residue> explain_residue(const Scene& scene, const VoxelGrid& voxels, const VoxelSet& may_fall,
                                     std::uint64_t seed, const Helpers& helpers, const Watch& watch);

}  // namespace sculpt
