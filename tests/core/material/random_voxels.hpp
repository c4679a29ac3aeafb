// Noise to try algorithms on.
#pragma once

#include "core/base/random.hpp"
#include "core/material/voxel_set.hpp"

namespace sculpt {

/// Each voxel stands with the probability `share`.
inline VoxelSet random_voxels(int n, double share, Random& random) {
  VoxelSet voxels(n);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (random.unit() < share) voxels.insert({i, j, k});
  return voxels;
}

}  // namespace sculpt
