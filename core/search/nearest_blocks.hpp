// The blocks that can be carved next, and which of them greedy best-first search takes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/material/octree.hpp"

namespace sculpt {

/// Candidates of every size, in one tree of counts a size, so that a query looks at a few blocks only. Ids are those of
/// the octree.
class NearestBlocks {
 public:
  explicit NearestBlocks(const Octree& octree);

  void insert(std::uint32_t block);
  void erase(std::uint32_t block);
  bool empty() const { return size_ == 0; }

  /// The block with the least (voxels left after it) + (L1 from `from` to its nearest voxel); ties go to the larger
  /// block, then to the lower id. Must not be empty.
  std::uint32_t best(Voxel from) const;

 private:
  /// Blocks of one size. Level 0 has the cells that hold blocks, the last level is the root; cells are in x-fastest
  /// order.
  struct Tier {
    int block_size, cell_size;
    std::vector<std::vector<std::uint32_t>> cells;
    std::vector<std::vector<std::uint32_t>> counts;
  };
  struct Best;

  Tier& tier_of(std::uint32_t block);
  void count(Tier& tier, Voxel corner, int change);
  void visit(const Tier& tier, Voxel cell, int level, Voxel from, Best& best) const;

  const Octree& octree_;
  std::vector<Tier> tiers_;  ///< by log2 of the block size
  std::size_t size_ = 0;
};

}  // namespace sculpt
