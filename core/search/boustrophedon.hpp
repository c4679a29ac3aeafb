// The way through a block: there and back along its rows, as an ox ploughs.
#pragma once

#include "core/material/octree.hpp"

namespace sculpt {

/// Which of the two ends of a block, along one axis, is nearer.
inline int nearer_end(int at, int low, int size) {
  return at - low < low + size - 1 - at ? low : low + size - 1;
}

inline Voxel nearest_corner(const Block& block, Voxel from) {
  return {nearer_end(from.i, block.corner.i, block.size), nearer_end(from.j, block.corner.j, block.size),
          nearer_end(from.k, block.corner.k, block.size)};
}

/// From `entered`, a voxel of the block: to the corner nearest to it, then row by row there and back, layer by layer.
/// `go(from, to)` is called for each straight line.
template <typename Go>
void walk_rows(const Block& block, Voxel entered, const Go& go) {
  const Voxel corner = nearest_corner(block, entered);
  Voxel at = entered;
  const auto go_to = [&](Voxel to) {
    if (to != at) go(at, to);
    at = to;
  };
  go_to({corner.i, at.j, at.k});
  go_to({corner.i, corner.j, at.k});
  go_to(corner);
  const Voxel in = corner - block.corner;
  Voxel along{in.i == 0 ? 1 : -1, 0, 0}, aside{0, in.j == 0 ? 1 : -1, 0};
  const Voxel deeper{0, 0, in.k == 0 ? 1 : -1};
  for (int layer = 0; layer < block.size; ++layer) {
    if (layer > 0) go_to(at + deeper);
    for (int row = 0; row < block.size; ++row) {
      if (row > 0) go_to(at + aside);
      go_to(at + along * (block.size - 1));
      along = along * -1;
    }
    aside = aside * -1;
  }
}

}  // namespace sculpt
