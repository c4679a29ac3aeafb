// What a second clamping would add, of the same target turned over: an estimate.
#pragma once

#include <string>
#include <vector>

#include "core/place/demand.hpp"

namespace sculpt {

/// How the block is clamped the second time.
struct TurnOver {
  std::string name;  ///< as a person would say it
  Vec3 rotate_deg;   ///< about the fixed x, y, z axes, as the placement of a mesh is given
  Share share;       ///< that the two clampings reach together, at one stand
};

/// By half a turn about x, and by quarters about x and y, each with the arm as it is in `reach`; best first. The grid
/// turns onto itself. What holds the block then, and how exactly it is put back, is not looked at. Throws Cancelled.
std::vector<TurnOver> rate_turn_overs(const VoxelGrid& voxels, Access access, const ArmReach& reach,
                                      const RunContext& run);

}  // namespace sculpt
