// A set of voxels that straight motions of a cutter take from.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/material/voxel_set.hpp"
#include "core/trajectory/milling/swept_voxels.hpp"

namespace sculpt {

/// Voxels of a grid that no motion has swept yet. Not shared between threads.
class SweptSet {
 public:
  /// Words of the set and the bits that were taken from them.
  using Taken = std::vector<std::pair<std::size_t, std::uint64_t>>;

  SweptSet(VoxelSet voxels, const Grid& grid) : centres_(grid), voxels_(std::move(voxels)) {}

  const VoxelSet& voxels() const { return voxels_; }
  /// Takes out what the cutter sweeps, going straight from one tip to the other; gives how many these were, and adds
  /// them to `taken`.
  std::uint32_t take(const SweptCutter& cutter, const QuantaPoint& from, const QuantaPoint& to, Taken* taken = nullptr);
  void give_back(const Taken& taken);

 private:
  VoxelCentres centres_;
  VoxelSet voxels_;
};

}  // namespace sculpt
