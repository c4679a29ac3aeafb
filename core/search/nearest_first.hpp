// The order in which trees of cubes are looked through for what is nearest (L1). Internal to the trees of search/.
#pragma once

#include <algorithm>

#include "core/material/voxel.hpp"

namespace sculpt {

/// How far `at` is outside of size voxels from `low` on.
inline int outside(int at, int low, int size) {
  return std::max(std::max(low - at, at - (low + size - 1)), 0);
}

/// Of the eight cubes of `half` voxels an edge at `corner`: calls `visit(which, corner, distance)`, the one that is
/// nearest to `from` first. `which`: a bit for each axis.
template <typename Visit>
void visit_eighths(Voxel corner, int half, Voxel from, const Visit& visit) {
  // How far outside of the lower and of the upper half, by axis.
  const int x[]{outside(from.i, corner.i, half), outside(from.i, corner.i + half, half)};
  const int y[]{outside(from.j, corner.j, half), outside(from.j, corner.j + half, half)};
  const int z[]{outside(from.k, corner.k, half), outside(from.k, corner.k + half, half)};
  const unsigned nearest = (x[1] < x[0] ? 1u : 0u) | (y[1] < y[0] ? 2u : 0u) | (z[1] < z[0] ? 4u : 0u);
  for (unsigned flip : {0u, 1u, 2u, 4u, 3u, 5u, 6u, 7u}) {
    const unsigned which = nearest ^ flip, i = which & 1, j = which >> 1 & 1, k = which >> 2;
    visit(which, corner + Voxel{static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)} * half,
          x[i] + y[j] + z[k]);
  }
}

/// Of aligned cubes of 1, 2, 4... voxels in a grid of 2^log_n an edge those of the smallest size, from 2^`smallest` on,
/// of which two an axis hold all that is within `reach` of `from`: calls `visit(log_size, corner, distance)`, the one
/// that is nearest first.
template <typename Visit>
void visit_cubes_about(Voxel from, int reach, int smallest, int log_n, const Visit& visit) {
  reach = std::min(reach, 4 << log_n);
  int log_size = smallest;
  while (log_size < log_n && (1 << log_size) < 2 * reach) ++log_size;
  const int size = 1 << log_size, last = (1 << (log_n - log_size)) - 1;
  const auto cubes = [&](int at, int(&cube)[2]) {
    const int low = std::clamp((at - reach) >> log_size, 0, last), high = std::clamp((at + reach) >> log_size, 0, last);
    cube[0] = std::clamp(at >> log_size, low, high);
    cube[1] = cube[0] == low ? high : low;
    return low == high ? 1 : 2;
  };
  int x[2], y[2], z[2];
  const int xs = cubes(from.i, x), ys = cubes(from.j, y), zs = cubes(from.k, z);
  for (int k = 0; k < zs; ++k)
    for (int j = 0; j < ys; ++j)
      for (int i = 0; i < xs; ++i) {
        const Voxel corner = Voxel{x[i], y[j], z[k]} * size;
        visit(log_size, corner,
              outside(from.i, corner.i, size) + outside(from.j, corner.j, size) + outside(from.k, corner.k, size));
      }
}

}  // namespace sculpt
