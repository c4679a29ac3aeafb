// What surely stands no more: the grid's cube less what the plan has cut. Internal to core/timing.
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
  bool is_open(Voxel voxel, std::size_t direction, bool may_stand);
  /// The same of a box of columns: nothing from the layer of `low` on, for low up to and including `high` across the
  /// direction. False for more than `most` columns.
  bool are_open(Voxel low, Voxel high, std::size_t direction, int most);

 private:
  struct Ray;
  bool stands(std::size_t bit) const;
  bool stands_from(int layer, const Ray& ray, int first, int second);
  int layer_of(int coordinate, const Ray& ray) const;
  std::size_t bit(Voxel voxel) const {
    const auto n = static_cast<std::size_t>(n_);
    return static_cast<std::size_t>(voxel.i) +
           n * (static_cast<std::size_t>(voxel.j) + n * static_cast<std::size_t>(voxel.k));
  }

  int n_;
  std::vector<std::uint64_t> standing_;
  /// Of every column along each direction a layer beyond which nothing stands; -1: nothing does. Lowered when asked.
  std::array<std::vector<std::int16_t>, 6> highest_;
};

}  // namespace sculpt
