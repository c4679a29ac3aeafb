// A plan and a place in it -> what stands then.
#pragma once

#include <iosfwd>
#include <string_view>

#include "core/material/voxel_grid.hpp"
#include "core/trajectory/header.hpp"

namespace sculpt {

/// A moment of a plan of K keyframes is a share of it: share * K keyframes are over, the last of them in part, of whose
/// cut that part of the voxels is gone (as the page counts them).
struct StockMoment {
  TrajectoryHeader header;
  VoxelGrid start;            ///< at the start
  VoxelSet standing;          ///< at the moment
  VoxelSet left;              ///< to be removed and never cut
  int tool = 0;               ///< of those milling tools that the header names
  Configuration q;            ///< joints at the moment; empty where the plan does not say them
  std::uint64_t removed = 0;  ///< voxels gone
  std::uint64_t keyframes = 0;
};

/// Of a timeline. `ended`: nothing more will come, so that what it does not cut is left. `share`: 0 to 1. Throws
/// InputError `trajectory_invalid`.
StockMoment moment_of_timeline(std::string_view bytes, double share, bool ended);

/// Of a trajectory, which does not say what the stock was: it is taken to fill the grid, and what is never cut to be
/// the target. The stream is read twice, from its start. Throws the same.
StockMoment moment_of_trajectory(std::istream& in, double share);

/// Are these the first bytes of a timeline, and not of a trajectory? (Theirs differ behind the header line.)
bool is_timeline(std::string_view bytes);

}  // namespace sculpt
