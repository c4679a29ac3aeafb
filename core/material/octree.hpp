// VoxelGrid -> Octree. Leaves are sorted by the Morton code of their corner; a leaf's id is its index.
#pragma once

#include <algorithm>
#include <vector>

#include "core/base/watch.hpp"
#include "core/material/voxel_grid.hpp"

namespace sculpt {

/// A leaf: an aligned cube of `size` voxels an edge, all of one label.
struct Block {
  Voxel corner;
  int size = 1;
  Label label = Label::air;
  bool operator==(const Block&) const = default;

  bool contains(Voxel v) const {
    return v.i >= corner.i && v.j >= corner.j && v.k >= corner.k && v.i < corner.i + size && v.j < corner.j + size &&
           v.k < corner.k + size;
  }
  /// L1 from `v`, which may be outside the grid, to the nearest voxel of the block.
  int distance(Voxel v) const {
    const auto gap = [&](int at, int low) { return std::max(std::max(low - at, at - (low + size - 1)), 0); };
    return gap(v.i, corner.i) + gap(v.j, corner.j) + gap(v.k, corner.k);
  }
};

/// Every voxel of the grid lies in exactly one leaf, and no eight siblings of one label are left unmerged.
struct Octree {
  int n = 0;
  std::vector<Block> leaves;

  /// Id of the leaf that holds `v` (inside the grid). O(log leaves).
  int find(Voxel v) const;
};

/// Throws Cancelled.
Octree build_octree(const VoxelGrid& voxels, const Watch& watch);

}  // namespace sculpt
