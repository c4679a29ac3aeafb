// The cubes that a study of stands cuts the grid into: one question to the arm for each of them and each direction.
#pragma once

#include <vector>

#include "core/sweep/reach/tool_view.hpp"

namespace sculpt {

inline constexpr int sectors_along = 4;  ///< each edge of the grid
inline constexpr int all_sectors = sectors_along * sectors_along * sectors_along;

/// Of a sector, by its place among the sectors of the grid (or of a view).
inline std::size_t sector_index(Voxel sector) {
  return static_cast<std::size_t>(sector.i + sectors_along * (sector.j + sectors_along * sector.k));
}
inline bool is_sector(Voxel sector) {
  return Grid{sectors_along, 1, Vec3::Zero()}.contains(sector);
}
/// The sector that a voxel of an n^3 grid is in; n is a power of two, 4 or more.
inline Voxel sector_of(Voxel voxel, int n) {
  const int edge = n / sectors_along;
  return {voxel.i / edge, voxel.j / edge, voxel.k / edge};
}

/// The directions that a study asks for, of a grid of n: the straight ones, then the tilted ones, as sweeps number
/// them.
inline std::vector<ToolView> study_views(int n) {
  std::vector<ToolView> views;
  for (const ToolView& view : tool_views(n)) views.push_back(view);
  for (const ToolView& view : tilted_views(n)) views.push_back(view);
  return views;
}
inline constexpr std::size_t all_views = 17;

}  // namespace sculpt
