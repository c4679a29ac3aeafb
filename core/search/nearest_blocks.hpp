// The blocks that can be carved next, and which of them greedy best-first search takes.
#pragma once

#include <bit>

#include "core/material/octree.hpp"
#include "core/search/block_tree.hpp"
#include "core/search/voxel_tree.hpp"

namespace sculpt {

/// Blocks to remove, by size, so that a query looks at a few of them only.
class NearestBlocks {
 public:
  /// For the blocks of a grid of `n` voxels an edge.
  explicit NearestBlocks(int n);

  void insert(const Block& block);
  /// `block` must be among them.
  void erase(const Block& block);
  bool empty() const { return count_ == 0; }
  bool contains(const Block& block) const {
    return tiers_[static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(block.size)))].contains(block.corner);
  }

  /// The block with the least (voxels left after it) + (L1 from `from` to its nearest voxel); of equals the larger one,
  /// then whichever `VoxelTree::nearest` finds. Must not be empty.
  Block best(Voxel from) const;

  /// The block nearest to `from` by L1; nothing if none is nearer than `most`.
  std::optional<Block> nearest(Voxel from, int most) const;

 private:
  VoxelTree& tier_of(const Block& block);

  std::vector<VoxelTree> tiers_;  ///< by log2 of the block size
  BlockTree all_;
  std::size_t count_ = 0;
};

}  // namespace sculpt
