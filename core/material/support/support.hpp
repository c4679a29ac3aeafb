// What holds the material while it is carved: a voxel is supported if face-connected standing voxels join it to layer
// k = 0, which stands on the table.
#pragma once

#include <cstdint>
#include <vector>

#include "core/material/loose_pieces.hpp"
#include "core/material/voxel_set.hpp"

namespace sculpt {

/// The standing voxels, and which removal would free a piece of them: leave a voxel unsupported that was supported.
/// What hangs on nothing at the start does so for ever and is never freed. Exact. Two bits a voxel. Reads from several
/// threads are safe, changes are not. Needs n a power of two, n >= 4.
class Support {
 public:
  /// A piece of nothing but voxels of `may_fall` may be freed.
  Support(const VoxelSet& standing, const VoxelSet& may_fall);

  const VoxelSet& standing() const { return standing_; }

  /// Would the removal of this standing voxel free a piece that may not fall? A few ns where the voxel is the top of a
  /// column that stands on the table, between such columns; tens of ns where its neighbours are joined right around it;
  /// else a search.
  bool frees(Voxel voxel) const;

  /// Removes a voxel that frees nothing.
  void remove(Voxel voxel);

  /// Removes the voxels of a line in order, up to the first that would free a piece; returns how many.
  int remove(const VoxelLine& line);

  /// Puts back what was removed, in any order.
  void restore(Voxel voxel);
  void restore(const VoxelLine& line);

 private:
  class Surroundings;

  std::int16_t& rooted(int i, int j) { return rooted_[column(i, j)]; }
  std::int16_t rooted(int i, int j) const { return rooted_[column(i, j)]; }
  std::size_t column(int i, int j) const {
    return static_cast<std::size_t>(i + 1) +
           static_cast<std::size_t>(standing_.n() + 2) * static_cast<std::size_t>(j + 1);
  }
  bool is_among_columns(std::size_t column, std::size_t voxel, int k) const;
  bool frees_if_apart(Voxel voxel) const;
  void remove(std::size_t column, std::size_t voxel, int k);
  bool frees_by_flood(Voxel voxel) const;

  VoxelSet standing_;
  VoxelSet loose_;  ///< what hung on nothing at the start
  VoxelSet may_fall_;
  std::vector<std::int16_t> rooted_;  ///< per column: voxels from k = 0 up without a gap; with a border
  std::int64_t unrooted_;             ///< voxels that stand above such a gap
};

}  // namespace sculpt
