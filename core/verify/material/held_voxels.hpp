// What of the material the table holds. Internal to verify/.
#pragma once

#include <cstdint>
#include <span>
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

  /// Puts back voxels that do not stand, all at once. Adds to `pieces`, for each face-connected piece of the others
  /// that was not held and is now, how many voxels it has; `unforeseen` are those of them that are not in `may_fall`.
  void put_back(std::span<const Voxel> voxels, const VoxelSet& may_fall, std::vector<Gain>& pieces);

  bool holds(Voxel voxel) const { return held_.contains(voxel); }

 private:
  /// Holds all that stands and is joined to a voxel without passing through those that are being put back.
  Gain hold_from(Voxel voxel, const VoxelSet& may_fall);
  bool is_beside_held(Voxel voxel) const;

  VoxelSet standing_, held_, back_;  ///< `back_`: being put back
  std::vector<Voxel> joined_;        ///< held since, and not looked around from
  std::vector<Voxel> piece_;
};

}  // namespace sculpt
