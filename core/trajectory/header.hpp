// What a trajectory is of: the first line of its file (docs/trajectory.md names the fields).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/frame.hpp"
#include "core/cell/milling/mill_tool.hpp"
#include "core/cell/tool.hpp"
#include "core/material/voxel.hpp"

namespace sculpt {

/// Of a plan with milling tools: format 2.
struct MillHeader {
  std::vector<MillTool> tools;  ///< the first one is in the spindle at the start
  /// From the tip towards the spindle, in the stock frame: whole numbers, so that all who read them agree exactly.
  std::vector<std::array<int, 3>> directions;
  double stray_m = 0;       ///< how far a point of the cutter may be from where a straight motion of it would have it
  std::string mesh_sha256;  ///< of the mesh file's bytes
};

struct TrajectoryHeader {
  std::vector<std::string> joints;  ///< names of the chain's coordinates
  Configuration home;
  Grid grid;  ///< resolution, voxel_m, origin_m
  Tool tool;
  double tolerance_m = 0;    ///< how far the ball's centre may be from a voxel's centre when it removes it
  std::string cell, search;  ///< names, for people
  std::uint64_t seed = 0;
  std::optional<MillHeader> mill;  ///< then `tool` means nothing, and `tolerance_m` is that of the surface
  bool held = false;  ///< of a translating robot's plan: no cut frees a piece that may not fall; of others always so
};

}  // namespace sculpt
