// The parts that a study of stands cuts the grid into: one question to the arm for each of them and each direction.
//
// Along an edge of 32 voxels the ball is tried at 4 places, from the first voxel to the last, and each voxel belongs to
// the nearest one:
//
//      0    5          16         26    31     voxels
//      x----|----x-----|-----x----|-----x      x: at 0, 10.3, 20.7 and 31

#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/sweep/reach/tool_view.hpp"

namespace sculpt {

inline constexpr int sectors_along = 4;  ///< each edge of the grid
inline constexpr int all_sectors = sectors_along * sectors_along * sectors_along;

/// Of a sector, by its place among the sectors of the grid (or of a view).
inline std::size_t sector_index(Voxel sector) {
  const int index = sector.i + sectors_along * (sector.j + sectors_along * sector.k);
  return static_cast<std::size_t>(index);
}
inline bool is_sector(Voxel sector) {
  return Grid{sectors_along, 1, Vec3::Zero()}.contains(sector);
}
/// Where the ball is tried along one edge of n voxels: 0 is the middle of the first, n - 1 that of the last.
inline double sector_middle(int sector, int n) {
  return sector * (n - 1.0) / (sectors_along - 1);
}
/// The sector whose place is nearest to one given in voxels, n^3 of which are the grid.
inline Voxel sector_of(const Vec3& place, int n) {
  const auto nearest = [n](double at) {
    const double share = at * (sectors_along - 1) / (n - 1);
    return static_cast<int>(std::lround(std::clamp(share, 0.0, sectors_along - 1.0)));
  };
  return {nearest(place.x()), nearest(place.y()), nearest(place.z())};
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
