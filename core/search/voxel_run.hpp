// A straight run of the translating robot.
#pragma once

#include "core/material/voxel.hpp"

namespace sculpt {

/// One straight run along one axis. A cut removes every voxel first..last; the robot stands at a face neighbour of
/// `first` on the run's own line or turns into it from one. A travel goes from `first`, where the robot stands, to
/// `last` through air.
struct VoxelRun {
  bool cut = false;
  Voxel first, last;
};

/// Above the corner of the grid: where paths start and end if nothing is there. Positions may leave the grid
/// by one voxel at the sides and above, never below the floor.
inline Voxel translating_entry(int n) {
  return {0, 0, n};
}

}  // namespace sculpt
