// Trajectory -> verdict: replays what was emitted with its own kinematics, its own material and FCL. Includes nothing
// of search/ or motion/.
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/base/watch.hpp"
#include "core/cell/cell.hpp"
#include "core/material/voxel_grid.hpp"
#include "core/verify/findings/findings.hpp"
#include "core/verify/findings/surface_verdict.hpp"
#include "core/verify/robot/exempt_pair.hpp"

namespace sculpt {

struct Verdict {
  bool clean = false;
  std::uint64_t collisions = 0;           ///< all findings, also those not listed
  std::uint64_t voxels_checked = 0;       ///< voxels whose removal was replayed
  std::uint64_t freed = 0;                ///< voxels that came loose from the table; of milled plans: as no mere chips
  VoxelSet left;                          ///< material that still stands at the end
  std::vector<Finding> findings;          ///< the first 100
  std::vector<ExemptPair> exempt_pairs;   ///< links with shapes that were not kept apart
  std::optional<SurfaceVerdict> surface;  ///< where milling tools were used
};

struct ReplaySettings {
  int threads = 1;        ///< each has a material of its own; the verdict is the same at any number
  bool thorough = false;  ///< FCL and octomap decide all, motion by motion; slow, and of the same verdict
  /// Until it says no the calling thread, which asks, does without the others; they are there by then. Nothing: never.
  std::function<bool()> alone = {};
};

/// Replays the trajectory in `in` in the given cell on the given material. Clean means: header agrees with cell
/// and grid, start and end at home, joint limits kept, every removed voxel a remove voxel removed once with the ball
/// within tolerance of its centre, no contact of tool or link with material, room or itself at any time (the tool may
/// touch the voxel being cut, nothing else may), nothing of keep removed; and, unless the chain only translates and the
/// header does not say `held`, no removal frees a piece of the material that the table held, but for parts of the
/// target that nothing can hold. Throws InputError `trajectory_invalid` for text that is no trajectory; Cancelled.
/// `watch` is told from the calling thread. `note` is told how far it is after each piece, from any thread but one at a
/// time; with that as `done` a replay of the same trajectory goes on from there.
Verdict verify_trajectory(std::istream& in, const Cell& cell, const VoxelGrid& voxels, const Watch& watch,
                          ReplaySettings settings = {}, ReplayedPieces done = {},
                          const std::function<void(const ReplayedPieces&)>& note = {});

}  // namespace sculpt
