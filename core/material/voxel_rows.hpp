// Rows of a voxel set along x as machine words, for the stages that work on 64 voxels at a time.
#pragma once

#include <algorithm>

#include "core/material/voxel_set.hpp"

namespace sculpt {

/// A row along x (fixed j, k) is `chunks` chunks of `width` voxels, the lowest i in the lowest bit. Needs n a power of
/// two, n >= 4.
struct VoxelRows {
  explicit VoxelRows(int grid_n) : n(grid_n), width(std::min(grid_n, 64)), chunks(grid_n / width) {}

  std::uint64_t mask() const { return width == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1; }
  std::uint64_t get(const VoxelSet& set, int j, int k, int chunk) const {
    const std::size_t at = set.index({chunk * width, j, k});
    return (set.words()[at >> 6] >> (at & 63)) & mask();
  }
  void put(VoxelSet& set, int j, int k, int chunk, std::uint64_t bits) const {
    const std::size_t at = set.index({chunk * width, j, k});
    std::uint64_t& word = set.words()[at >> 6];
    word = (word & ~(mask() << (at & 63))) | (bits << (at & 63));
  }

  int n, width, chunks;
};

}  // namespace sculpt
