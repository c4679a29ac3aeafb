// A voxel that was left, and why.
#pragma once

#include "core/material/voxel.hpp"

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

}  // namespace sculpt
