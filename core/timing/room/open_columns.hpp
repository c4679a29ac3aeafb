// What surely stands no more: the grid's cube less what the plan has cut, as the highest voxel of every column along
// each of its six directions. Internal to core/timing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/material/voxel.hpp"

namespace sculpt {

/// Whatever stock a plan was made for lies in the cube, so what is free here is free.
class OpenColumns {
 public:
  explicit OpenColumns(int n);

  void remove(Voxel voxel);

  /// Seen along `direction` (of face_steps), does nothing stand in the voxel's column beyond it, and, unless
  /// `may_stand`, in the voxel itself? Voxels outside the grid count as empty.
  bool is_open(Voxel voxel, std::size_t direction, bool may_stand) const;
  /// The same of a box of columns: nothing from the layer of `low` on, for low up to and including `high` across the
  /// direction. False for more than `most` columns.
  bool are_open(Voxel low, Voxel high, std::size_t direction, int most) const;

 private:
  bool stands(Voxel voxel) const;
  /// The layer of the highest that stands, from this voxel on against the direction.
  std::int16_t next_below(Voxel voxel, std::size_t direction) const;
  std::size_t bit(Voxel voxel) const {
    const auto n = static_cast<std::size_t>(n_);
    return static_cast<std::size_t>(voxel.i) +
           n * (static_cast<std::size_t>(voxel.j) + n * static_cast<std::size_t>(voxel.k));
  }
  std::size_t column(Voxel voxel, std::size_t direction) const;

  int n_;
  std::vector<std::uint64_t> standing_;
  std::array<std::vector<std::int16_t>, 6> highest_;  // by layer along the direction, -1: none
};

/// How far along a direction of face_steps a voxel lies: from 0 to n - 1 in the grid.
int layer_of(Voxel voxel, std::size_t direction, int n);

}  // namespace sculpt
