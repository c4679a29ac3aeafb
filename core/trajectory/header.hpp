// What a trajectory is of: the first line of its file (docs/trajectory.md names the fields).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/frame.hpp"
#include "core/cell/tool.hpp"
#include "core/material/voxel.hpp"

namespace sculpt {

struct TrajectoryHeader {
  std::vector<std::string> joints;  ///< names of the chain's coordinates
  Configuration home;
  Grid grid;  ///< resolution, voxel_m, origin_m
  Tool tool;
  double tolerance_m = 0;    ///< how far the ball's centre may be from a voxel's centre when it removes it
  std::string cell, search;  ///< names, for people
  std::uint64_t seed = 0;
  bool held = false;  ///< of a translating robot's plan: no cut frees a piece that may not fall; of others always so
};

}  // namespace sculpt
