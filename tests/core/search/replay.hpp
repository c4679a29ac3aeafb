// Replays the runs of the translating robot voxel by voxel; shares nothing with the search but the words.
#pragma once

#include <string>
#include <vector>

#include "core/material/voxel_grid.hpp"
#include "core/search/translating.hpp"

namespace sculpt {

struct Replayed {
  std::string fault;  ///< what the first wrong run did; empty if none
  VoxelSet removed;
  std::uint64_t cut = 0, travelled = 0;  ///< steps from voxel to voxel
};

Replayed replay(const VoxelGrid& voxels, const std::vector<VoxelRun>& runs);

std::vector<VoxelRun> carve(const VoxelGrid& voxels);

/// Remove voxels that a plain flood from outside, not through the floor, does not come to.
VoxelSet enclosed_by_flood(const VoxelGrid& voxels);

/// Blobs, noise or both, some with air at the start. The same for the same seed.
VoxelGrid random_voxels(int n, std::uint64_t seed);

}  // namespace sculpt
