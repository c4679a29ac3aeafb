// What of the material the table holds. Internal to verify/.
#pragma once

#include <cstdint>
#include <vector>

#include "core/material/voxel_grid.hpp"

namespace sculpt {

/// The parts of the finished sculpture, with what they enclose, that nothing joins to layer k = 0: once all around them
/// is gone nothing can hold them.
VoxelSet find_never_held(const VoxelGrid& voxels);

/// Standing voxels, and which of them a path over faces joins to layer k = 0. Material only comes back: what is held
/// stays held.
class HeldVoxels {
 public:
  explicit HeldVoxels(const VoxelSet& standing);

  struct Gain {
    std::uint64_t all = 0, unforeseen = 0;
  };

  /// Puts back a voxel that does not stand. Counts the other voxels that were not held and are now; `unforeseen` are
  /// those of them that are not in `may_fall`.
  Gain put_back(Voxel voxel, const VoxelSet& may_fall);

  bool holds(Voxel voxel) const { return held_.contains(voxel); }

 private:
  VoxelSet standing_, held_;
  std::uint64_t hanging_;  ///< stand and are not held
  std::vector<Voxel> here_, next_;
};

}  // namespace sculpt
