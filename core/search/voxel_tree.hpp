// A set of voxels that knows how far the nearest of them is.
#pragma once

#include <cstdint>
#include <vector>

#include "core/material/voxel.hpp"

namespace sculpt {

/// An octree of bits: one byte for each cube of 2, 4, 8... voxels says which of its eight parts hold a voxel of the
/// set. Takes n^3 / 7 bytes; changing a voxel and asking for a near one look at a few bytes only. Needs n a power of
/// two.
class VoxelTree {
 public:
  explicit VoxelTree(int n);

  void insert(Voxel v);
  /// `v` must be in the set.
  void erase(Voxel v);
  bool contains(Voxel v) const { return parts_[0][cube(v, 0)] >> part(v, 0) & 1; }
  bool empty() const { return parts_.back()[0] == 0; }

  /// L1 from `from`, which may be outside the grid, to the nearest voxel of the set, or `most` if none is nearer.
  int distance(Voxel from, int most) const;

 private:
  /// Index among the cubes of edge 2 << level.
  std::size_t cube(Voxel v, int level) const {
    const int shift = level + 1, bits = log_n_ - shift;
    return static_cast<std::size_t>(v.i >> shift) | static_cast<std::size_t>(v.j >> shift) << bits |
           static_cast<std::size_t>(v.k >> shift) << 2 * bits;
  }
  /// Which eighth of its cube a voxel is in.
  static int part(Voxel v, int level) { return (v.i >> level & 1) | (v.j >> level & 1) << 1 | (v.k >> level & 1) << 2; }
  void visit(Voxel corner, int level, Voxel from, int& best) const;

  int log_n_;
  std::vector<std::vector<std::uint8_t>> parts_;  ///< by level: edge 2 first, the whole grid last
};

}  // namespace sculpt
