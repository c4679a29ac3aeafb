// What every voxel of the grid is at the start: air, keep or remove.
#pragma once

#include "core/material/voxel_set.hpp"

namespace sculpt {

enum class Label : std::uint8_t { air, keep, remove };

/// `stock`: voxels filled at the start; `keep`: voxels of the target that are in the stock (a subset of `stock`).
struct VoxelGrid {
  VoxelSet stock;
  VoxelSet keep;

  int n() const { return stock.n(); }
  Label label(Voxel v) const {
    if (!stock.contains(v)) return Label::air;
    return keep.contains(v) ? Label::keep : Label::remove;
  }
};

}  // namespace sculpt
