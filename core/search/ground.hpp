// What a search of the translating robot begins with, besides the voxels.
#pragma once

#include <utility>
#include <vector>

#include "core/material/support/support.hpp"

namespace sculpt {

/// Where the robot is, where it ends, and where it cannot go. Where the room lets it into no voxel of the grid, that
/// voxel is given to the search as one to keep.
struct Ground {
  Voxel start, end;
  std::vector<Voxel> closed = {};                     ///< positions beside the grid where it cannot be
  std::vector<std::pair<Voxel, Voxel>> blocked = {};  ///< neighbours between which it cannot go, either way
  const Support* support = nullptr;                   ///< no piece of this may come free; null: any may
};

}  // namespace sculpt
