// A set of voxels, or of aligned cubes of one size, that knows which of them is nearest.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/material/voxel.hpp"

namespace sculpt {

/// An octree of bits: one byte for each cube of 2, 4, 8... elements says which of its eight parts hold one of the set.
/// Takes (n / size)^3 / 7 bytes; changing an element and asking for a near one look at a few bytes only.
class VoxelTree {
 public:
  /// Of cubes of `size` voxels an edge, at multiples of it, in a grid of `n`; both powers of two.
  explicit VoxelTree(int n, int size = 1);

  /// A cube is named by any voxel of it.
  void insert(Voxel v);
  /// `v` must be in the set.
  void erase(Voxel v);
  bool contains(Voxel v) const { return parts_[0][cube(v, 0)] >> part(v, 0) & 1; }
  bool empty() const { return parts_.back()[0] == 0; }

  struct Nearest {
    Voxel corner;  ///< of the cube
    int distance;  ///< L1 to its nearest voxel
  };
  /// The cube nearest to `from`, which may be outside the grid; nothing if none is nearer than `most`. Which
  /// of equals is settled, but not by a simple rule.
  std::optional<Nearest> nearest(Voxel from, int most) const;
  /// The same, but of equals another: looks at the cubes about `from` only where `most` is small.
  std::optional<Nearest> nearest_about(Voxel from, int most) const;
  /// L1 from `from` to the nearest voxel of the set, or `most` if none is nearer.
  int distance(Voxel from, int most) const {
    const auto found = nearest_about(from, most);
    return found ? found->distance : most;
  }

 private:
  /// Index among the cubes of edge (2 << level) elements.
  std::size_t cube(Voxel v, int level) const {
    const int shift = log_size_ + level + 1, bits = log_n_ - level - 1;
    return static_cast<std::size_t>(v.i >> shift) | static_cast<std::size_t>(v.j >> shift) << bits |
           static_cast<std::size_t>(v.k >> shift) << 2 * bits;
  }
  /// Which eighth of its cube a voxel is in.
  int part(Voxel v, int level) const {
    const int shift = log_size_ + level;
    return (v.i >> shift & 1) | (v.j >> shift & 1) << 1 | (v.k >> shift & 1) << 2;
  }
  void visit(Voxel corner, int level, Voxel from, Nearest& best) const;

  int log_size_, log_n_;                          ///< of an element in voxels; of the grid in elements, at least 1
  std::vector<std::vector<std::uint8_t>> parts_;  ///< by level: edge 2 first, the whole grid last
};

}  // namespace sculpt
