// The grid as the tool sees it: columns along its axis, layers across.
#pragma once

#include <array>

#include "core/material/voxel.hpp"

namespace sculpt {

/// Turns a cell (a, b, c) into a voxel: c grows against the way in, that is along the tool's axis from the ball to the
/// spindle, a along the rows that are cut. Cells outside 0..n-1 are voxels outside the grid.
struct ToolView {
  int n = 0;
  Voxel corner;               ///< voxel of cell (0, 0, 0)
  std::array<Voxel, 3> step;  ///< one cell along a, b, c

  Voxel voxel(Voxel cell) const { return corner + step[0] * cell.i + step[1] * cell.j + step[2] * cell.k; }
  Vec3 axis() const { return {double(step[2].i), double(step[2].j), double(step[2].k)}; }
  /// Where the ball's centre is at a place given in cells, whole numbers being their centres (m, stock frame).
  Vec3 ball_m(const Grid& grid, const Vec3& cell) const {
    const auto real = [](Voxel v) { return Vec3(v.i, v.j, v.k); };
    const Vec3 at = real(corner) + real(step[0]) * cell.x() + real(step[1]) * cell.y() + real(step[2]) * cell.z();
    return grid.origin_m + grid.voxel_m * (at + Vec3::Constant(0.5));
  }
};

/// Tool axis +z, then the four sides +x, +y, -x, -y, each the one before it turned by a quarter about z.
inline std::array<ToolView, 5> tool_views(int n) {
  const Voxel x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const int last = n - 1;
  return {{{n, {0, 0, 0}, {x, y, z}},
           {n, {0, 0, 0}, {y, z, x}},
           {n, {last, 0, 0}, {x * -1, z, y}},
           {n, {last, last, 0}, {y * -1, z, x * -1}},
           {n, {0, last, 0}, {x, z, y * -1}}}};
}

}  // namespace sculpt
