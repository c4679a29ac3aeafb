// What every voxel of the grid is at the start: air, keep or remove.
#pragma once

#include "core/material/voxel_set.hpp"

namespace sculpt {

enum class Label : std::uint8_t { air, keep, remove };

/// Voxels of which the mesh does not say for sure whether they are inside, and the box from `low` to `high` around
/// them.
struct Ambiguous {
  std::uint64_t voxels = 0;
  Voxel low{}, high{};
};

/// `stock`: voxels filled at the start; `keep`: voxels of the target that are in the stock (a subset of `stock`).
struct VoxelGrid {
  VoxelSet stock;
  VoxelSet keep;
  Ambiguous ambiguous{};  ///< of the target

  int n() const { return stock.n(); }
  Label label(Voxel v) const {
    if (!stock.contains(v)) return Label::air;
    return keep.contains(v) ? Label::keep : Label::remove;
  }
};

}  // namespace sculpt
