// A step of a trajectory.
#pragma once

#include "core/base/frame.hpp"
#include "core/material/voxel.hpp"

namespace sculpt {

/// Linear joint motion from the previous keyframe (the first one starts at home) to q. A cut removes the straight run
/// of voxels first..last (along one axis), the m-th of n at path parameter m/n; a move removes nothing.
struct Keyframe {
  Configuration q;
  bool cut = false;
  Voxel first, last;
};

/// Number of voxels of a cut's run.
int run_length(const Keyframe& keyframe);

}  // namespace sculpt
