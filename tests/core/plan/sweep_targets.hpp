// Targets that sweeps have trouble with.
#pragma once

#include <algorithm>
#include <utility>

#include "core/base/random.hpp"
#include "core/material/voxel_set.hpp"

namespace sculpt {

/// Full of holes: voxels that no tool comes to, and closed chambers.
inline VoxelSet riddled_target(int n, std::uint64_t seed) {
  Random random(seed);
  VoxelSet target(n);
  const double share = random.between(0.2, 0.7);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (random.unit() < share) target.insert({i, j, k});
  return target;
}

/// A box with walls of one voxel, open along one of its edges as far as a third of the two walls there: what lies
/// behind them needs a tool that leans out through the gap.
inline VoxelSet split_box(int n, std::uint64_t seed) {
  const int low = n / 8, high = n - 1 - n / 8, gap = n / 4;
  const auto depth = [&](Voxel v, int wall) {
    const int depths[]{high - v.k, high - v.i, v.i - low, high - v.j, v.j - low, v.k};
    return depths[wall];
  };
  const std::pair<int, int> edges[]{{0, 1}, {1, 3}, {0, 4}, {2, 4}, {0, 2}, {3, 2}};
  const auto [first, second] = edges[seed % 6];
  VoxelSet target(n);
  for_each_voxel(VoxelSet(n, true), [&](Voxel v) {
    int least = n;
    for (int wall = 0; wall < 6; ++wall)
      if (wall != first && wall != second) least = std::min(least, depth(v, wall));
    const int a = depth(v, first), b = depth(v, second);
    if (least < 0 || a < 0 || b < 0) return;
    const bool open = a < gap && b < gap && least > 0;
    if (!open && std::min({least, a, b}) == 0) target.insert(v);
  });
  return target;
}

}  // namespace sculpt
