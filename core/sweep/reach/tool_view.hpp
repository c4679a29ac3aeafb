// The grid as the tool sees it: columns along its axis, layers across.
#pragma once

#include <array>
#include <vector>

#include "core/material/voxel.hpp"

namespace sculpt {

/// Turns a cell (a, b, c) into a voxel: c grows against the way in, that is along the tool's axis from the ball to the
/// spindle, a along the rows that are cut. A tilted axis goes along more than one of them, always the way they grow.
/// Cells outside 0..n-1 are voxels outside the grid.
struct ToolView {
  int n = 0;
  Voxel corner;               ///< voxel of cell (0, 0, 0)
  std::array<Voxel, 3> step;  ///< one cell along a, b, c
  Voxel lean{0, 0, 1};        ///< the tool's axis in cells: 0 or 1 each, along c always 1
  Vec3 held = Vec3::Zero();   ///< the tool's axis (unit vector, stock frame) where it is none of these

  Voxel along(Voxel cells) const { return step[0] * cells.i + step[1] * cells.j + step[2] * cells.k; }
  Voxel voxel(Voxel cell) const { return corner + along(cell); }
  Voxel cell(Voxel voxel) const {
    const Voxel off = voxel - corner;
    const auto part = [off](Voxel unit) { return off.i * unit.i + off.j * unit.j + off.k * unit.k; };
    return {part(step[0]), part(step[1]), part(step[2])};
  }
  static Vec3 place(Voxel cell) {
    return {static_cast<double>(cell.i), static_cast<double>(cell.j), static_cast<double>(cell.k)};
  }
  Vec3 axis() const {
    if (!held.isZero()) return held;
    const Voxel way = along(lean);
    return Vec3(way.i, way.j, way.k).normalized();
  }
  /// Where the ball's centre is at a place given in cells, whole numbers being their centres (m, stock frame).
  Vec3 ball_m(const Grid& grid, const Vec3& cell) const {
    const auto real = [](Voxel v) { return Vec3(v.i, v.j, v.k); };
    const Vec3 at = real(corner) + real(step[0]) * cell.x() + real(step[1]) * cell.y() + real(step[2]) * cell.z();
    return grid.origin_m + grid.voxel_m * (at + Vec3::Constant(0.5));
  }
};

/// Turned by a quarter about z, from x to y.
inline ToolView quarter_turned(ToolView view) {
  view.corner = {};
  for (Voxel& step : view.step) {
    step = {-step.j, step.i, step.k};
    if (step.i + step.j + step.k < 0) view.corner = view.corner - step * (view.n - 1);
  }
  view.held = {-view.held.y(), view.held.x(), view.held.z()};
  return view;
}

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

/// Tool axes between those, along the diagonals of the faces and of the cube that do not point down: leaning over one
/// side from above, lying between two sides, and between two sides and above. Of each four, every one but the first the
/// one before it turned by a quarter about z.
inline std::vector<ToolView> tilted_views(int n) {
  const Voxel x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  std::vector<ToolView> views;
  for (ToolView view : {ToolView{n, {}, {x, y, z}, {1, 0, 1}}, ToolView{n, {}, {x, z, y}, {1, 0, 1}},
                        ToolView{n, {}, {x, y, z}, {1, 1, 1}}})
    for (int quarter = 0; quarter < 4; ++quarter, view = quarter_turned(view)) views.push_back(view);
  return views;
}

}  // namespace sculpt
