// A set of blocks of any sizes that knows which of them is nearest.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/material/octree.hpp"

namespace sculpt {

/// Like VoxelTree, for aligned cubes that do not overlap: of each cube of 2, 4, 8... voxels two bytes say which of its
/// eight parts hold a block, and which are one.
class BlockTree {
 public:
  /// In a grid of `n` voxels an edge, a power of two.
  explicit BlockTree(int n);

  void insert(const Block& block);
  /// `block` must be in the set.
  void erase(const Block& block);

  struct Nearest {
    Voxel corner;
    int size;
    int distance;  ///< L1 to its nearest voxel
  };
  /// The block nearest to `from`, which may be outside the grid; nothing if none is nearer than `most`. Which of equals
  /// is settled, but not by a simple rule.
  std::optional<Nearest> nearest(Voxel from, int most) const;

 private:
  struct Parts {
    std::uint8_t hold = 0, are = 0;  ///< a bit for each eighth
  };

  /// Index among the cubes of edge 2 << level.
  std::size_t cube(Voxel v, int level) const {
    const int shift = level + 1, bits = std::max(log_n_ - shift, 0);
    return static_cast<std::size_t>(v.i >> shift) | static_cast<std::size_t>(v.j >> shift) << bits |
           static_cast<std::size_t>(v.k >> shift) << 2 * bits;
  }
  /// Which eighth of it a voxel is in.
  static int part(Voxel v, int level) { return (v.i >> level & 1) | (v.j >> level & 1) << 1 | (v.k >> level & 1) << 2; }
  void visit(Voxel corner, int level, Voxel from, Nearest& best) const;

  int log_n_;
  std::vector<std::vector<Parts>> parts_;  ///< by level: edge 2 first, twice the grid's last
};

}  // namespace sculpt
